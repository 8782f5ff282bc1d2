#include "sample/implicit/root_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pdc::detail {
namespace {

constexpr double kDifferenceStep = 1e-3;  // voxels

/// How far within an edge normals are taken where it is crossed at its very end: an edge or a corner of a solid may lie
/// in that lattice point, and has several normals, of which the one along the edge is meant.
constexpr double kBesideEnd = 0x1p-20;  // voxels

double besideEnd(double t) { return t == 0 ? kBesideEnd : t == 1 ? 1 - kBesideEnd : t; }

/// g / |g|, or zero if g has no direction. Scaled first, because the squares of usable gradients may under- or
/// overflow.
Vec3d direction(const Vec3d& g) {
  const double largest = std::max({std::abs(g.x), std::abs(g.y), std::abs(g.z)});
  if (!(largest >= std::numeric_limits<double>::min())) return {};
  const Vec3d scaled{g.x / largest, g.y / largest, g.z / largest};
  const Vec3d n = scaled * (1 / length(scaled));
  return std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z) ? n : Vec3d{};
}

/// Slope from the values at -h, 0 and h; NaN if fewer than two neighbouring ones are finite.
double slope(double below, double here, double above, double h) {
  if (std::isfinite(below) && std::isfinite(above)) return (above - below) / (2 * h);
  return std::isfinite(above) ? (above - here) / h : (here - below) / h;
}

Vec3d differenceGradient(const Field& field, const Vec3d& p, double h) {
  constexpr std::size_t kPoints = 7;
  std::array<double, kPoints> x, y, z, value;
  x.fill(p.x);
  y.fill(p.y);
  z.fill(p.z);
  x[1] -= h;
  x[2] += h;
  y[3] -= h;
  y[4] += h;
  z[5] -= h;
  z[6] += h;
  field.values({x.data(), y.data(), z.data(), kPoints}, value.data());
  return {slope(value[1], value[0], value[2], h), slope(value[3], value[0], value[4], h),
          slope(value[5], value[0], value[6], h)};
}

}  // namespace

void findRootNormals(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, const double* t,
                     HermiteBlock& hermite, std::size_t first) {
  EdgePoints points;
  for (std::size_t i = 0; i < edges.size; ++i) points.place(i, frame, edges, i, besideEnd(t[i]));
  std::array<double, EdgeBatch::kCapacity> value, gx, gy, gz;
  field.gradients(points.span(edges.size), value.data(), {gx.data(), gy.data(), gz.data()});
  for (std::size_t i = 0; i < edges.size; ++i) {
    Vec3d n = direction({gx[i], gy[i], gz[i]});
    if (n == Vec3d{}) {
      const Vec3d p{points.p[0][i], points.p[1][i], points.p[2][i]};
      n = direction(differenceGradient(field, p, kDifferenceStep * frame.voxelSize));
    }
    hermite.nx[first + i] = static_cast<float>(n.x);
    hermite.ny[first + i] = static_cast<float>(n.y);
    hermite.nz[first + i] = static_cast<float>(n.z);
  }
}

}  // namespace pdc::detail
