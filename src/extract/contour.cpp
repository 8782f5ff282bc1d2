#include "pdc/extract/contour.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "extract/block_topology.h"
#include "extract/fill_mesh.h"
#include "with_threads.h"

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
  if (!std::is_sorted(blocks.coords.begin(), blocks.coords.end()))
    throw std::invalid_argument("contour: the source's blocks are not sorted");
  const detail::Topology topology = detail::buildTopology(blocks, monitor);
  detail::checkVertexCount(topology.vertexCount);
  Mesh mesh;
  const detail::VertexCounts counts = fillMesh(source, blocks, topology, options, mesh, monitor);
  if (report != nullptr)
    *report = {blocks.coords.size(), counts.crossings,          counts.outOfCell,    counts.moved,
               topology.openArcs,    topology.multiVertexCells, counts.withoutNormal};
  return mesh;
}

}  // namespace

Mesh contour(const HermiteSource& source, const ContourOptions& options, ContourReport* report,
             const Monitor& monitor) {
  checkOptions(options);
  return detail::withThreads(options.threads, [&] { return run(source, options, report, monitor); });
}

}  // namespace pdc
