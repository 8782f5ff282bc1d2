#include "points/growing_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pdc::detail {
namespace {

constexpr double kLeastCosine = 0.5, kLeastDepth = 0.15;

struct Point2 {
  double x, y;
};
using Triangle2 = std::array<Point2, 3>;

/// The least depth by which two triangles overlap along the normals of one's sides; negative if they are apart.
double leastDepth(const Triangle2& sides, const Triangle2& other) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 &p = sides[k], &q = sides[(k + 1) % 3];
    const double size = std::hypot(q.x - p.x, q.y - p.y);
    const Point2 n{(q.y - p.y) / size, (p.x - q.x) / size};
    const auto range = [&n](const Triangle2& t) {
      const std::array along{n.x * t[0].x + n.y * t[0].y, n.x * t[1].x + n.y * t[1].y, n.x * t[2].x + n.y * t[2].y};
      return std::minmax({along[0], along[1], along[2]});
    };
    const auto [lo, hi] = range(sides);
    const auto [otherLo, otherHi] = range(other);
    least = std::min({least, hi - otherLo, otherHi - lo});
  }
  return least;
}

}  // namespace

void GrowingSurface::add(const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    mCorners[a].push_back({b, c});
    if (across(b, a) != kNone) {
      --mOpen[b];
    } else {
      ++mOpen[a];
    }
  }
  mTriangles.push_back(t);
}

bool coverEachOther(std::span<const Vec3d, 3> a, std::span<const Vec3d, 3> b, double height) {
  const Vec3d na = cross(a[1] - a[0], a[2] - a[0]), nb = cross(b[1] - b[0], b[2] - b[0]);
  const double sizeA = length(na), sizeB = length(nb);
  if (!(sizeA > 0) || !(sizeB > 0) || std::abs(dot(na, nb)) < kLeastCosine * sizeA * sizeB) return false;
  const Vec3d n = na * (1 / sizeA), along = a[1] - a[0], u = along * (1 / length(along)), v = cross(n, u);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : b) least = std::min(least, std::abs(dot(n, p - a[0])));
  if (least > height) return false;
  Triangle2 flatA{}, flatB{};
  for (std::size_t k = 0; k < 3; ++k) {
    flatA[k] = {dot(u, a[k] - a[0]), dot(v, a[k] - a[0])};
    flatB[k] = {dot(u, b[k] - a[0]), dot(v, b[k] - a[0])};
  }
  const double most = kLeastDepth * std::sqrt(std::min(sizeA, sizeB));
  return leastDepth(flatA, flatB) > most && leastDepth(flatB, flatA) > most;
}

}  // namespace pdc::detail
