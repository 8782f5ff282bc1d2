#include "field/field_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pdc::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string text(const Vec3d& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); }
std::string text(const Box& box) { return text(box.lo) + " to " + text(box.hi); }

/// A batch that owns its points and results.
struct Batch {
  std::vector<double> x, y, z, value, gx, gy, gz;

  explicit Batch(std::size_t size) : x(size), y(size), z(size), value(size), gx(size), gy(size), gz(size) {}

  [[nodiscard]] PointSpan points(std::size_t first, std::size_t size) const {
    return {x.data() + first, y.data() + first, z.data() + first, size};
  }
  GradientSpan gradients(std::size_t first) { return {gx.data() + first, gy.data() + first, gz.data() + first}; }
};

bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// Differences along the axes, and the largest mismatch between the two one-sided ones.
struct Differences {
  Vec3d gradient;
  double mismatch = 0;

  Differences(const Field& field, const Vec3d& p, double step) {
    const double middle = field.valueAt(p);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d up = p, down = p;
      up[axis] += step;
      down[axis] -= step;
      const double above = field.valueAt(up), below = field.valueAt(down);
      gradient[axis] = (above - below) / (up[axis] - down[axis]);
      mismatch = std::max(mismatch, std::abs(above - 2 * middle + below) / step);
    }
  }
};

}  // namespace

std::ostream& operator<<(std::ostream& out, const FieldCase& c) { return out << c.name; }

Box Random::boxIn(const Box& region, double smallest, double largest) {
  const Vec3d center = in(region);
  const double size = std::exp(in(std::log(smallest), std::log(largest)));
  const Vec3d half = Vec3d{in(0.2, 1), in(0.2, 1), in(0.2, 1)} * (size / 2);
  return {center - half, center + half};
}

void expectGradientsMatchDifferences(const FieldCase& c) {
  constexpr int kPoints = 500;
  constexpr double kStep = 1e-5, kSmooth = 2e-3, kTolerance = 1e-5;
  Random random(1);
  int used = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3d p = random.in(c.region);
    const Differences expected(*c.field, p, kStep);
    if (!(expected.mismatch < kSmooth)) continue;
    ++used;
    const Vec3d g = c.field->gradientAt(p);
    ASSERT_LT(length(g - expected.gradient), kTolerance * std::max(1.0, length(g))) << c.name << " at " << text(p);
    if (c.distance) {
      ASSERT_NEAR(length(g), 1, 1e-9) << c.name << " at " << text(p);
    }
  }
  EXPECT_GT(used, kPoints * 8 / 10);
}

void expectBoundsHold(const FieldCase& c) {
  constexpr int kBoxes = 2000, kPointsPerBox = 32;
  constexpr double kRounding = 1e-7;
  Random random(2);
  const double slope = c.field->lipschitz();
  for (int i = 0; i < kBoxes; ++i) {
    const Box box = random.boxIn(c.region, 1e-3, 10);
    const Interval bound = c.field->bound(box);
    ASSERT_LE(bound.lo, bound.hi) << c.name << " in " << text(box);
    const double atCenter = c.field->valueAt(box.center());
    for (int k = 0; k < kPointsPerBox; ++k) {
      // Some on the corners, edges and faces, where the largest values are.
      Vec3d p = random.in(box);
      for (int axis = 0; axis < 3; ++axis) {
        const double where = random.in(0, 1);
        if (where < 0.3) p[axis] = box.lo[axis];
        if (where > 0.7) p[axis] = box.hi[axis];
      }
      const double value = c.field->valueAt(p);
      ASSERT_TRUE(bound.contains(value)) << c.name << " in " << text(box) << ": " << value << " not in " << bound.lo
                                         << " to " << bound.hi;
      if (slope < kInfinity) {
        ASSERT_LE(std::abs(value - atCenter), slope * length(p - box.center()) * (1 + 1e-9) + kRounding) << c.name;
      }
    }
  }
}

void expectBoundsConverge(const FieldCase& c) {
  Random random(3);
  for (const double size : {1e-2, 1e-3, 1e-4, 1e-6}) {
    for (int i = 0; i < 100; ++i) {
      const Box box = random.boxIn(c.region, size, size);
      const Interval bound = c.field->bound(box);
      const double rounding = 1e-8 + 1e-11 * std::abs(box.lo.x);
      ASSERT_LE(bound.hi - bound.lo, 2 * c.slope * box.radius() + rounding) << c.name << " in " << text(box);
    }
  }
}

void expectBatchesAgree(const FieldCase& c) {
  constexpr std::size_t kPoints = Field::kMaxBatch;
  Random random(4);
  Batch whole(kPoints), parts(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3d p = random.in(c.region);
    whole.x[i] = parts.x[i] = p.x;
    whole.y[i] = parts.y[i] = p.y;
    whole.z[i] = parts.z[i] = p.z;
  }
  c.field->gradients(whole.points(0, kPoints), whole.value.data(), whole.gradients(0));
  for (std::size_t first = 0, size = 1; first < kPoints; first += size, ++size) {
    size = std::min(size, kPoints - first);
    c.field->gradients(parts.points(first, size), parts.value.data() + first, parts.gradients(first));
  }
  std::vector<double> values(kPoints);
  c.field->values(whole.points(0, kPoints), values.data());
  for (std::size_t i = 0; i < kPoints; ++i) {
    const Vec3d p{whole.x[i], whole.y[i], whole.z[i]};
    ASSERT_TRUE(sameBits(whole.value[i], parts.value[i])) << c.name << " at " << text(p);
    ASSERT_TRUE(sameBits(whole.value[i], values[i])) << c.name << " at " << text(p);
    ASSERT_TRUE(sameBits(whole.value[i], c.field->valueAt(p))) << c.name << " at " << text(p);
    ASSERT_TRUE(sameBits(whole.gx[i], parts.gx[i]) && sameBits(whole.gy[i], parts.gy[i]) &&
                sameBits(whole.gz[i], parts.gz[i]))
        << c.name << " at " << text(p);
  }
}

}  // namespace pdc::test
