#include "pdc/field/mesh_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "field/boundary.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "mesh/faces.h"
#include "mesh/point_triangle.h"
#include "mesh/triangle_tree.h"
#include "mesh/winding/lattice_line.h"
#include "mesh/winding/winding_number.h"
#include "pdc/error.h"

namespace pdc {
namespace {

using detail::WindingNumber;

/// Where caps add less to the winding number, the level 1/2 is not near.
constexpr double kLittle = 0.05;

Mesh ownTriangles(const detail::ClosedSurface& surface) {
  Mesh own;
  own.positions = surface.surface.positions;
  own.triangles.assign(surface.surface.triangles.begin(),
                       surface.surface.triangles.begin() + static_cast<std::ptrdiff_t>(surface.own));
  return own;
}

double sizeOf(const Mesh& mesh) {
  float size = 0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) size = std::max(size, largestEntry(mesh.positions[v]));
  return size + largestEntry(mesh.origin);
}

Buffer<std::uint32_t> allTriangles(const Mesh& mesh) {
  Buffer<std::uint32_t> numbers(mesh.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

class MeshField final : public Field {
 public:
  explicit MeshField(const Mesh& mesh)
      : mSurface(detail::closeSurface(mesh)),
        mOwn(ownTriangles(mSurface)),
        mTree(mOwn, allTriangles(mOwn)),
        mWinding(mSurface),
        mOrigin(mesh.origin),
        mSize(sizeOf(mSurface.surface)) {
    if (mOwn.triangles.empty()) throw Error("the mesh has no triangle with finite corners");
  }

  void values(PointSpan points, double* values) const override {
    Nearest found;
    Vec3d last{};
    double winding = 0;
    for (std::size_t i = 0; i < points.size; ++i) {
      const Vec3d p = place(points, i);
      // No triangle is between two points if one is nearer to the other than to all triangles.
      const bool same = i > 0 && mWinding.caps().empty() && squared(p - last) < kNearer * found.squared;
      if (!same) winding = mWinding.at(p);
      found = nearest(p, found.number);
      last = p;
      double distance = std::sqrt(found.squared);
      if (nearLevel(p)) distance = std::min(distance, levelAt(p, winding).distance);
      values[i] = signedValue(distance, winding);
    }
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    for (std::size_t i = 0; i < points.size; ++i) {
      const detail::ValueGradient f = gradient(place(points, i));
      values[i] = f.value;
      gradients.x[i] = f.gradient.x;
      gradients.y[i] = f.gradient.y;
      gradients.z[i] = f.gradient.z;
    }
  }

  [[nodiscard]] Interval bound(const Box& box) const override {
    const Box local{box.lo - mOrigin, box.hi - mOrigin};
    const double radius = local.radius(), rounding = mSize + largestEntry(box);
    if (!(radius < detail::kUsual)) return Interval::whole();
    const double d = std::sqrt(nearest(local.center()).squared);
    if (mWinding.caps().empty()) {
      const double value = signedValue(d, mWinding.at(local.center()));
      return detail::widened(Interval{value - radius, value + radius}, rounding);
    }
    constexpr double kSureLevel = 0.45;
    Interval size{d - radius, d + radius};
    if (d <= radius || !(mWinding.caps().bound(local, kSureLevel) < kSureLevel))
      return detail::widened(Interval{-size.hi, size.hi}, rounding);
    size = detail::widened(size, rounding);
    // What is no distance from triangles may be any number above 0.
    size.lo = std::min(size.lo, std::numeric_limits<double>::min());
    return WindingNumber::isInside(mWinding.at(local.center())) ? -size : size;
  }

  [[nodiscard]] double lipschitz() const override {
    return mWinding.caps().empty() ? 1 : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool definedIn(const Box& box) const override {
    return mSize < detail::kUsual && largestEntry(box) < detail::kUsual;
  }

 private:
  /// A triangle and the square of a point's distance from it.
  struct Nearest {
    double squared = std::numeric_limits<double>::infinity();
    std::uint32_t number = kNone;
  };

  /// The nearest triangle, the first of those that are equally near. All that are as near but for rounding are looked
  /// at, so that the answer does not depend on the guess.
  [[nodiscard]] Nearest nearest(const Vec3d& p, std::uint32_t guess = kNone) const {
    Nearest best;
    double reach = best.squared;
    const auto visit = [&](std::uint32_t i) {
      const double squared = detail::squaredToTriangle(p, mSurface.points(i));
      if (squared > best.squared || (squared == best.squared && i > best.number)) return;
      const double beyond = std::sqrt(squared) + kRounding * (mSize + largestEntry(p));
      best = {squared, i};
      reach = beyond * beyond;
    };
    if (guess != kNone) visit(guess);
    mTree.visitNearest(p, reach, visit);
    return best;
  }

  /// The winding number's level 1/2 near a point, to first order.
  struct Level {
    double distance;
    Vec3d outwards;  ///< A unit vector.
  };

  [[nodiscard]] Vec3d place(PointSpan points, std::size_t i) const {
    return Vec3d{points.x[i], points.y[i], points.z[i]} - mOrigin;
  }

  [[nodiscard]] double signedValue(double distance, double winding) const {
    return detail::closed(WindingNumber::isInside(winding) ? -distance : distance, detail::kBoundary * mSize);
  }

  [[nodiscard]] bool nearLevel(const Vec3d& p) const {
    return !mWinding.caps().empty() && !(mWinding.caps().bound({p, p}, kLittle) < kLittle);
  }

  [[nodiscard]] Level levelAt(const Vec3d& p, double winding) const {
    const Vec3d change = mWinding.caps().gradient(p);
    const double slope = length(change);
    if (!(slope > 0)) return {std::numeric_limits<double>::infinity(), {}};
    return {std::abs(std::abs(winding) - 0.5) / slope, change * ((winding > 0 ? 1 : -1) / slope)};
  }

  [[nodiscard]] detail::ValueGradient gradient(const Vec3d& p) const {
    const Nearest found = nearest(p);
    const double winding = mWinding.at(p), distance = std::sqrt(found.squared);
    if (nearLevel(p))
      if (const Level level = levelAt(p, winding); level.distance < distance)
        return {signedValue(level.distance, winding), level.outwards};
    const bool inside = WindingNumber::isInside(winding);
    const std::array<Vec3d, 3> t = mSurface.points(found.number);
    // Nearer the direction from the nearest point is that of rounding.
    if (!(distance > kOnSurface * mSize)) return {signedValue(distance, winding), normalAt(p, t, winding)};
    const auto w = detail::nearestPoint(p, t[0], t[1], t[2]);
    const Vec3d away = p - (t[0] * w[0] + t[1] * w[1] + t[2] * w[2]);
    const double l = length(away);
    return {signedValue(distance, winding), l > 0 ? away * ((inside ? -1 : 1) / l) : normalAt(p, t, winding)};
  }

  /// The triangle's normal, turned to the side that is outside.
  [[nodiscard]] static Vec3d normalAt(const Vec3d& p, const std::array<Vec3d, 3>& t, double winding) {
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    const double l = length(n);
    if (!(l > 0)) return {};
    const double behind = detail::sideOfPlane(p, t) < 0 ? winding : winding + 1;
    return n * ((WindingNumber::isInside(behind) ? 1 : -1) / l);
  }

  [[nodiscard]] static double squared(const Vec3d& v) { return dot(v, v); }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr double kRounding = 1e-14;
  static constexpr double kOnSurface = 1e-12, kNearer = 0.999;

  detail::ClosedSurface mSurface;
  Mesh mOwn;
  detail::TriangleTree mTree;
  WindingNumber mWinding;
  Vec3d mOrigin;
  double mSize;
};

}  // namespace

FieldPtr meshField(const Mesh& mesh) { return std::make_shared<MeshField>(mesh); }

}  // namespace pdc
