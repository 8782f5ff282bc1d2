#include "pdc/sample/crease_points.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "sample/surface_pairs.h"

namespace pdc {
namespace {

using detail::SurfacePoint;

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// The point of the surface near p, by Newton's steps along the gradient; empty where the field has none.
std::optional<SurfacePoint> project(const Field& field, Vec3d p) {
  constexpr int kSteps = 8;
  SurfacePoint best{};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    double value = 0;
    Vec3d g{};
    field.gradients({&p.x, &p.y, &p.z, 1}, &value, {&g.x, &g.y, &g.z});
    const double squared = dot(g, g);
    if (!(squared > 0) || !std::isfinite(squared) || !std::isfinite(value)) return std::nullopt;
    // Across a crease the steps may not settle; the nearest place then serves.
    if (std::abs(value) < least) {
      least = std::abs(value);
      best = {p, g * (1 / std::sqrt(squared))};
    }
    p -= g * (value / squared);
  }
  return best;
}

std::optional<Vec3d> creaseBetween(const Field& field, SurfacePoint a, SurfacePoint b, double voxelSize) {
  constexpr double kFromDegrees = 30, kLeftDegrees = 25, kResolution = 1e-4;  // voxels
  constexpr int kMaxHalvings = 40;
  const auto turn = [&] { return dot(a.normal, b.normal); };
  if (a.normal == Vec3d{} || b.normal == Vec3d{} || turn() > cosine(kFromDegrees)) return std::nullopt;
  for (int i = 0; i < kMaxHalvings && length(a.position - b.position) > kResolution * voxelSize; ++i) {
    const auto middle = project(field, (a.position + b.position) * 0.5);
    if (!middle) return std::nullopt;
    (dot(middle->normal, a.normal) > dot(middle->normal, b.normal) ? a : b) = *middle;
  }
  if (turn() > cosine(kLeftDegrees) || length(a.position - b.position) > kResolution * voxelSize) return std::nullopt;
  return (a.position + b.position) * 0.5;
}

}  // namespace

std::vector<Vec3f> creasePoints(const FieldPtr& field, const HermiteSource& source, const Monitor& monitor) {
  if (field == nullptr) throw std::invalid_argument("creasePoints: no field");
  const double voxelSize = source.map().voxelSize();
  return detail::mapSurfacePairs<Vec3f>(source, monitor, [&](const auto& a, const auto& b, auto& found) {
    if (const auto p = creaseBetween(*field, a, b, voxelSize)) found.push_back(vecCast<float>(*p));
  });
}

}  // namespace pdc
