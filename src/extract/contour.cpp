#include "pdc/extract/contour.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <optional>
#include <stdexcept>

#include "extract/block_faces.h"
#include "extract/block_topology.h"
#include "extract/block_vertices.h"
#include "extract/vertex_solver.h"

namespace pdc {
namespace {

void checkOptions(const ContourOptions& options) {
  if (!(options.sigmaNormal >= 0))
    throw std::invalid_argument(fmt::format("contour: sigmaNormal is {}, must be at least 0", options.sigmaNormal));
  if (options.threads < 0)
    throw std::invalid_argument(fmt::format("contour: threads is {}, must be at least 0", options.threads));
}

Mesh run(const HermiteSource& source, const ContourOptions& options, ContourReport* report, const Monitor& monitor) {
  const SurfaceBlocks blocks = source.surfaceBlocks(monitor);
  const detail::Topology topology = detail::buildTopology(blocks, monitor);
  detail::checkVertexCount(topology.vertexCount);
  Mesh mesh;
  mesh.positions.resize(topology.vertexCount);
  if (options.normals) mesh.normals.resize(topology.vertexCount);
  Buffer<detail::VertexError> errors(topology.vertexCount);
  const detail::VertexCounts counts =
      solveVertices(source, blocks, topology, detail::VertexSolver(options.sigmaNormal, options.placement),
                    {mesh.positions.data(), options.normals ? mesh.normals.data() : nullptr, errors.data()}, monitor);

  if (options.triangles) {
    mesh.triangles.resize(2 * topology.quadCount);
  } else {
    mesh.quads.resize(topology.quadCount);
  }
  detail::writeFaces(blocks, topology, errors.data(), source.map().mirrored(),
                     options.triangles ? nullptr : mesh.quads.data(),
                     options.triangles ? mesh.triangles.data() : nullptr, monitor);
  if (report != nullptr)
    *report = {blocks.coords.size(), counts.crossings,          counts.outOfCell,    counts.moved,
               topology.openArcs,    topology.multiVertexCells, counts.withoutNormal};
  return mesh;
}

}  // namespace

Mesh contour(const HermiteSource& source, const ContourOptions& options, ContourReport* report,
             const Monitor& monitor) {
  checkOptions(options);
  if (options.threads == 0) return run(source, options, report, monitor);
  // More threads than processors have to be allowed first; TBB would warn on standard error otherwise.
  std::optional<tbb::global_control> allow;
  if (options.threads > tbb::info::default_concurrency())
    allow.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads);
  return arena.execute([&] { return run(source, options, report, monitor); });
}

}  // namespace pdc
