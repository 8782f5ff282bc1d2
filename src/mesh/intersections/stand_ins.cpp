#include "mesh/intersections/stand_ins.h"

#include <cmath>

#include "pdc/math/vec3.h"

namespace pdc::detail {
namespace {

Vec3d between(const Vec3f& from, const Vec3f& to) { return vecCast<double>(to) - vecCast<double>(from); }

}  // namespace

std::optional<TriangleCorners> arcStandIn(const Vec3f& hub, const Vec3f& a, const Vec3f& b) {
  const Vec3d toA = between(hub, a), toB = between(hub, b);
  const Vec3d p = toA * (1 / length(toA)), q = toB * (1 / length(toB));
  constexpr double kLeast = 1e-3;  // The least 1 + cosine of the angle: up to 177 degrees.
  const double denominator = 1 + dot(p, q);
  if (!(denominator > kLeast)) return std::nullopt;
  // An arc lies between its chord and the tangents at its ends, which meet here.
  const Vec3d tip = (p + q) * (1 / denominator);
  return TriangleCorners{vecCast<float>(p), vecCast<float>(q), vecCast<float>(tip)};
}

std::optional<TriangleCorners> pageStandIn(const Vec3f& v, const Vec3f& w, const Vec3f& p) {
  const Vec3d e = between(v, w), d = between(v, p), n = cross(e, d);
  constexpr double kLeastSine = 1e-8;  // Keeps the error of the direction of n below kStandInMargin.
  if (!(length(n) > kLeastSine * length(e) * length(d))) return std::nullopt;
  const auto unit = vecCast<float>(n * (1 / length(n)));
  return TriangleCorners{unit, unit, unit};
}

void StandIns::add(std::uint32_t triangle, const TriangleCorners& shape) {
  const auto first = static_cast<std::uint32_t>(shapes.positions.size());
  shapes.positions.insert(shapes.positions.end(), shape.begin(), shape.end());
  shapes.triangles.push_back({first, first + 1, first + 2});
  triangles.push_back(triangle);
}

}  // namespace pdc::detail
