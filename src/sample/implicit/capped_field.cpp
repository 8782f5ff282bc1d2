#include "sample/implicit/capped_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace pdc::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double slabs(const Box& box, double x, double y, double z) {
  return std::max({box.lo.x - x, x - box.hi.x, box.lo.y - y, y - box.hi.y, box.lo.z - z, z - box.hi.z});
}

/// Infinite values count as missing: whatever is not finite is outside.
double finiteOrNaN(double value) { return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN(); }

/// Whether the box decides, not the field. It does where both are zero: no cell beyond the box may hold surface. NaN
/// stays.
bool cuts(double cap, double value) { return cap > value || (cap == 0 && value == 0); }

Vec3d slabsGradient(const Box& box, double distance, const Vec3d& p) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d g{};
    g[axis] = 1;
    if (distance == p[axis] - box.hi[axis]) return g;
    if (distance == box.lo[axis] - p[axis]) return -g;
  }
  return {};
}

}  // namespace

CappedField::CappedField(FieldPtr field, double iso)
    : CappedField(std::move(field), iso, {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}) {}

CappedField::CappedField(FieldPtr field, double iso, const Box& box) : mField(std::move(field)), mIso(iso), mBox(box) {}

void CappedField::values(PointSpan points, double* values) const {
  mField->values(points, values);
  for (std::size_t i = 0; i < points.size; ++i) {
    const double value = finiteOrNaN(values[i]) - mIso, cap = slabs(mBox, points.x[i], points.y[i], points.z[i]);
    values[i] = cuts(cap, value) ? cap : value;
  }
}

void CappedField::gradients(PointSpan points, double* values, GradientSpan gradients) const {
  mField->gradients(points, values, gradients);
  for (std::size_t i = 0; i < points.size; ++i) {
    const Vec3d p{points.x[i], points.y[i], points.z[i]};
    values[i] = finiteOrNaN(values[i]) - mIso;
    const double cap = slabs(mBox, p.x, p.y, p.z);
    if (!cuts(cap, values[i])) continue;
    const Vec3d g = slabsGradient(mBox, cap, p);
    values[i] = cap;
    gradients.x[i] = g.x;
    gradients.y[i] = g.y;
    gradients.z[i] = g.z;
  }
}

Interval CappedField::bound(const Box& box) const {
  Interval cap{-kInfinity, -kInfinity};
  for (int axis = 0; axis < 3; ++axis) {
    cap = max(cap, {mBox.lo[axis] - box.hi[axis], mBox.lo[axis] - box.lo[axis]});
    cap = max(cap, {box.lo[axis] - mBox.hi[axis], box.hi[axis] - mBox.hi[axis]});
  }
  return max(mField->bound(box) + -mIso, cap);
}

FieldPtr CappedField::simplified(const Box& box) const {
  FieldPtr field = mField->simplified(box);
  return field ? std::make_shared<CappedField>(std::move(field), mIso, mBox) : nullptr;
}

}  // namespace pdc::detail
