#include "pdc/extract/contour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "extract/adapt.h"
#include "extract/contour_memory.h"
#include "extract/fill_and_certify.h"
#include "extract/mesh_origin.h"
#include "extract/topology/continuation.h"
#include "extract/topology/surface.h"
#include "extract/vertex_quadrics.h"
#include "mesh/polygons/split_quads.h"
#include "parallel/with_threads.h"
#include "sample/relocated_source.h"

namespace pdc {
namespace {

void checkOptions(const ContourOptions& options, const ContourReport* report) {
  if (options.sigmaNormal && !(*options.sigmaNormal >= 0))
    throw std::invalid_argument(fmt::format("contour: sigmaNormal is {}, must be at least 0", *options.sigmaNormal));
  if (options.quadrics && report == nullptr)
    throw std::invalid_argument("contour: quadrics are asked for without a report to put them into");
  if (options.adaptive && !(*options.adaptive > 0 && std::isfinite(*options.adaptive)))
    throw std::invalid_argument(
        fmt::format("contour: the adaptive distance is {}, must be above 0 and finite", *options.adaptive));
  if (options.adaptive && options.quadrics)
    throw std::invalid_argument("contour: quadrics are those of the full mesh, which is not what was asked for");
  if (const auto& o = options.origin; o && !(std::isfinite(o->x) && std::isfinite(o->y) && std::isfinite(o->z)))
    throw std::invalid_argument(fmt::format("contour: the origin is ({}, {}, {}), must be finite", o->x, o->y, o->z));
  if (options.threads < 0)
    throw std::invalid_argument(fmt::format("contour: threads is {}, must be at least 0", options.threads));
}

Mesh run(const HermiteSource& world, const ContourOptions& options, ContourReport* report, const Monitor& monitor) {
  const SurfaceBlocks blocks = world.surfaceBlocks(monitor);
  if (!std::is_sorted(blocks.coords.begin(), blocks.coords.end()))
    throw std::invalid_argument("contour: the source's blocks are not sorted");
  const detail::Topology topology = detail::buildTopology(blocks, monitor);
  detail::checkContinuation(blocks, topology);
  detail::checkVertexCount(topology.vertexCount);
  const auto vertices = static_cast<double>(topology.vertexCount);
  detail::checkMemory(detail::contourMemory(vertices, options), vertices, options);
  const detail::MeshOrigin place = detail::meshOrigin(world.map(), blocks, options.origin, options.exactSums);
  const detail::RelocatedSource relocated(world, world.map().relativeTo(place.origin, place.step));
  const bool moves = place.origin != Vec3d{};
  const HermiteSource& source = moves ? relocated : world;
  const detail::Surface surface{source, blocks, topology};
  Mesh mesh;
  mesh.origin = place.origin;
  const auto [sigma, counts, certified] = fillAndCertify(surface, options, mesh, monitor);
  Buffer<Quadric<float>> quadrics;
  if (options.quadrics) quadrics = vertexQuadrics(surface, sigma, mesh, monitor);
  detail::Adapted adapted;
  if (options.adaptive) {
    adapted = detail::adapt(mesh, options, place.step, monitor);
    mesh = std::move(adapted.mesh);
  }
  if (options.triangles) detail::splitQuads(mesh);
  if (report != nullptr)
    *report = {.blocks = blocks.coords.size(),
               .crossings = counts.crossings,
               .outOfCell = counts.outOfCell,
               .clamped = counts.moved,
               .boundaryEdges = topology.openArcs + certified.addedBoundaryEdges,
               .multiVertexCells = topology.multiVertexCells,
               .crossingsWithoutNormal = counts.withoutNormal,
               .shortened = certified.shortened,
               .drawnIn = certified.drawnIn,
               .forcedDiagonals = certified.forcedDiagonals,
               .fans = certified.fans,
               .normalNoise = counts.agreement.sigma(),
               .medianSigmaNormal = counts.sigmas.median(),
               .creasePatches = counts.creases,
               .trianglesBefore = adapted.trianglesBefore,
               .adaptedDistance = adapted.distance,
               .uncertified = certified.uncertified,
               .quadrics = std::move(quadrics)};
  return mesh;
}

}  // namespace

Mesh contour(const HermiteSource& source, const ContourOptions& options, ContourReport* report,
             const Monitor& monitor) {
  checkOptions(options, report);
  return detail::withThreads(options.threads, [&] { return run(source, options, report, monitor); });
}

}  // namespace pdc
