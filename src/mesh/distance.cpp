#include "pdc/mesh/distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_tree.h"
#include "pdc/error.h"

namespace pdc {
namespace {

double squaredToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double l = dot(ab, ab);
  const double t = l > 0 ? std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : 0;
  const Vec3d d = p - a - ab * t;
  return dot(d, d);
}

double squaredToTriangle(const Vec3d& p, const detail::TriangleCorners& corners) {
  const std::array<Vec3d, 3> v{vecCast<double>(corners[0]), vecCast<double>(corners[1]), vecCast<double>(corners[2])};
  const Vec3d n = cross(v[1] - v[0], v[2] - v[0]);
  const double area = dot(n, n);
  bool above = area > 0;
  for (int k = 0; k < 3 && above; ++k) above = dot(cross(n, v[(k + 1) % 3] - v[k]), p - v[k]) >= 0;
  if (above) {
    const double h = dot(n, p - v[0]);
    return h * h / area;
  }
  return std::min({squaredToSegment(p, v[0], v[1]), squaredToSegment(p, v[1], v[2]), squaredToSegment(p, v[2], v[0])});
}

Buffer<std::uint32_t> finiteTriangles(const Mesh& mesh) {
  Buffer<std::uint32_t> numbers;
  numbers.reserve(detail::triangleCount(mesh));
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const auto c = detail::corners(mesh, detail::triangle(mesh, i));
    if (std::all_of(c.begin(), c.end(), detail::isFinite)) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

/// \param offset what to add to the points to make them relative to the mesh's origin.
Buffer<double> measure(std::span<const Vec3f> points, const Vec3d& offset, const Mesh& mesh, const Monitor& monitor) {
  detail::checkSizes(mesh, "distances");
  detail::checkIndices(mesh);
  Buffer<std::uint32_t> triangles = finiteTriangles(mesh);
  if (triangles.empty()) throw Error("no distance: the mesh has no face with finite corners");
  const detail::TriangleTree tree(mesh, std::move(triangles));
  Buffer<double> result(points.size());
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kGrain = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& range) {
    monitor.throwIfStopped();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vec3d p = vecCast<double>(points[i]) + offset;
      double nearest = std::numeric_limits<double>::infinity();
      if (detail::isFinite(points[i]))
        tree.visitNearest(p, nearest, [&](std::uint32_t t) {
          nearest = std::min(nearest, squaredToTriangle(p, detail::corners(mesh, detail::triangle(mesh, t))));
        });
      result[i] = detail::isFinite(points[i]) ? std::sqrt(nearest) : std::numeric_limits<double>::quiet_NaN();
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
