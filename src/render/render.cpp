#include "pdc/render/render.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <stdexcept>

#include "mesh/mesh_checks.h"
#include "parallel/with_threads.h"
#include "render/tile.h"

namespace pdc {
namespace {

using detail::TileRenderer;

void checkOptions(const Mesh& mesh, const RenderOptions& options) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument("render: " + what); };
  for (const int pixels : {options.width, options.height})
    if (pixels < 1 || pixels > kMaxImageSide) refuse(fmt::format("{} pixels, must be 1 to {}", pixels, kMaxImageSide));
  if (options.threads < 0) refuse(fmt::format("threads is {}, must be at least 0", options.threads));
  if (options.shading == Shading::kValues && options.values.size() != mesh.positions.size())
    refuse(fmt::format("{} values for {} vertices", options.values.size(), mesh.positions.size()));
}

float highest(const detail::ViewMesh& mesh) {
  float top = 0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) top = std::max(top, mesh.positions[v].z);
  return top;
}

Image run(const Mesh& mesh, const RenderOptions& options, const Monitor& monitor) {
  const Camera camera =
      options.camera ? *options.camera : fitCamera({&mesh, 1}, options.towardsViewer, options.width, options.height);
  const detail::ViewMesh view = detail::viewMesh(mesh, camera, options.width, options.height);
  monitor.throwIfStopped();
  const detail::DividedTriangles divided = detail::divideTriangles(view, options.width, options.height);
  const bool whole = divided.slivers.empty();
  const detail::RayScene rays(view.positions, whole ? view.triangles : divided.others);
  std::optional<detail::RayScene> occluders;
  if (!whole) occluders.emplace(view.positions, divided.occluders);
  // Rays start one pixel above the mesh.
  const detail::Picture picture{view, divided, rays, whole ? rays : *occluders, options, highest(view) + 1};

  Image image{options.width, options.height, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const int across = (image.width + TileRenderer::kTilePixels - 1) / TileRenderer::kTilePixels;
  const int down = (image.height + TileRenderer::kTilePixels - 1) / TileRenderer::kTilePixels;
  tbb::enumerable_thread_specific<TileRenderer> renderers([&] { return TileRenderer(picture); });
  std::atomic<int> done = 0;
  tbb::parallel_for(tbb::blocked_range<int>(0, across * down, 1), [&](const auto& range) {
    for (int i = range.begin(); i != range.end(); ++i) {
      monitor.throwIfStopped();
      renderers.local().run(i % across * TileRenderer::kTilePixels, i / across * TileRenderer::kTilePixels, image);
      if (monitor.progress) monitor.progress("rendering", static_cast<double>(++done) / (across * down));
    }
  });
  return image;
}

}  // namespace

Image render(const Mesh& mesh, const RenderOptions& options, const Monitor& monitor) {
  detail::checkSizes(mesh, "render");
  checkOptions(mesh, options);
  return detail::withThreads(options.threads, [&] { return run(mesh, options, monitor); });
}

}  // namespace pdc
