#include "pdc/mesh/distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/nearest_triangles.h"
#include "pdc/error.h"

namespace pdc {
namespace {

/// \param offset what to add to the points to make them relative to the mesh's origin.
Buffer<double> measure(std::span<const Vec3f> points, const Vec3d& offset, const Mesh& mesh, const Monitor& monitor) {
  detail::checkSizes(mesh, "distances");
  detail::checkIndices(mesh);
  const detail::NearestTriangles triangles(mesh);
  if (triangles.empty()) throw Error("no distance: the mesh has no face with finite corners");
  Buffer<double> result(points.size());
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& range) {
    monitor.throwIfStopped();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const bool finite = detail::isFinite(points[i]);
      result[i] = finite ? std::sqrt(triangles.find(vecCast<double>(points[i]) + offset).squared)
                         : std::numeric_limits<double>::quiet_NaN();
    }
    if (monitor.progress)
      monitor.progress("measuring", static_cast<double>(done += range.size()) / static_cast<double>(points.size()));
  });
  return result;
}

}  // namespace

Buffer<double> distances(std::span<const Vec3f> points, const Mesh& mesh, const Monitor& monitor) {
  return measure(points, -mesh.origin, mesh, monitor);
}

Buffer<double> vertexDistances(const Mesh& from, const Mesh& mesh, const Monitor& monitor) {
  return measure(from.positions, from.origin - mesh.origin, mesh, monitor);
}

}  // namespace pdc
