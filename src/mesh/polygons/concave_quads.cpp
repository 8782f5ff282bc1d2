#include "mesh/polygons/concave_quads.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace pdc::detail {
namespace {

/// Whether two normals are almost the same direction; false if one is zero or not finite.
bool agree(const Vec3d& a, const Vec3d& b) {
  // Coordinates with four digits are flat to that. Of a million quads folded over their diagonal, as those at creases
  // are, seven were flat to 0.014 across the other, and none to this.
  constexpr double kMostSine = 2e-3;
  const double lengths = length(a) * length(b);
  return lengths > 0 && dot(a, b) > 0 && length(cross(a, b)) < kMostSine * lengths;
}

bool isBetterTurned(const Buffer<Vec3f>& positions, const Quad& q) {
  const auto edge = [&](int from, int to) {
    return vecCast<double>(positions[q[static_cast<std::size_t>(to)]]) -
           vecCast<double>(positions[q[static_cast<std::size_t>(from)]]);
  };
  const Vec3d diagonal = edge(0, 2);
  if (dot(cross(edge(0, 1), diagonal), cross(diagonal, edge(0, 3))) > 0) return false;
  const Vec3d other = edge(1, 3);
  return agree(cross(edge(1, 2), other), cross(other, edge(1, 0)));
}

}  // namespace

void turnConcaveQuads(Mesh& mesh) {
  constexpr std::size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.quads.size(), kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      if (isBetterTurned(mesh.positions, mesh.quads[i]))
        std::rotate(mesh.quads[i].begin(), mesh.quads[i].begin() + 1, mesh.quads[i].end());
  });
}

}  // namespace pdc::detail
