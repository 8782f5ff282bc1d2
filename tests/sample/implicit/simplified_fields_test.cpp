#include "sample/implicit/simplified_fields.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/field/function_field.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

using detail::LocalField;
using detail::SimplifiedFields;

const Box kBox{{-1, -1, -1}, {1, 1, 1}};

/// Another field, that does not simplify.
class PlainField final : public Field {
 public:
  explicit PlainField(FieldPtr field) : mField(std::move(field)) {}

  void values(PointSpan points, double* values) const override { mField->values(points, values); }
  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    mField->gradients(points, values, gradients);
  }
  [[nodiscard]] Interval bound(const Box& box) const override { return mField->bound(box); }
  [[nodiscard]] double lipschitz() const override { return mField->lipschitz(); }

 private:
  FieldPtr mField;
};

/// A sphere without gradients.
class SlopelessSphere final : public Field {
 public:
  SlopelessSphere(const Vec3d& center, double radius) : mSphere(sphere(center, radius)) {}

  void values(PointSpan points, double* values) const override { mSphere->values(points, values); }
  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    mSphere->gradients(points, values, gradients);
    for (double* component : {gradients.x, gradients.y, gradients.z}) std::fill_n(component, points.size, 0.0);
  }
  [[nodiscard]] Interval bound(const Box& box) const override { return mSphere->bound(box); }
  [[nodiscard]] bool definedIn(const Box& box) const override { return mSphere->definedIn(box); }

 private:
  FieldPtr mSphere;
};

/// Boxes side by side, whose faces touch, spheres, and struts across them.
std::vector<FieldPtr> lattice(int perAxis) {
  const double step = 2.0 / perAxis;
  std::vector<FieldPtr> parts;
  for (int i = 0; i < perAxis * perAxis * perAxis; ++i) {
    const Vec3d at =
        Vec3d{i / (perAxis * perAxis) + 0.5, i / perAxis % perAxis + 0.5, i % perAxis + 0.5} * step - Vec3d{1, 1, 1};
    if (i % 3 == 0) parts.push_back(box(at, {step / 2, step / 4, step / 4}));
    if (i % 3 == 1) parts.push_back(sphere(at, 0.55 * step));
    if (i % 3 == 2) parts.push_back(cylinder(at, at + Vec3d{step, step, -step}, 0.1 * step));
  }
  return parts;
}

bool sameMesh(const Mesh& a, const Mesh& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.size() == 0 || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
  };
  return same(a.positions, b.positions) && same(a.triangles, b.triangles) && same(a.quads, b.quads);
}

void expectSameMesh(const FieldPtr& field, const FieldSourceOptions& options) {
  const Mesh expected = contour(FieldSource(std::make_shared<PlainField>(field), options), {});
  const Mesh mesh = contour(FieldSource(field, options), {});
  EXPECT_GT(mesh.positions.size(), 1000u);
  EXPECT_TRUE(sameMesh(expected, mesh));
}

TEST(SimplifiedFields, MeshIsThatOfThePlainField) {
  const FieldPtr parts = unite(lattice(6));
  ASSERT_EQ(parts->parts(), 216u);
  for (const bool open : {false, true}) {
    expectSameMesh(parts, {.box = kBox, .voxelSize = 0.07, .open = open});
    expectSameMesh(parts, {.box = kBox, .voxelSize = 0.083, .iso = 0.02, .open = open});
  }
  expectSameMesh(rotate(complement(parts), {1, 2, 3}, 40), {.box = kBox, .voxelSize = 0.07});
  std::vector<FieldPtr> cut = lattice(6);
  cut.insert(cut.begin(), box({0, 0, 0}, {0.9, 0.8, 0.7}));
  expectSameMesh(subtract(std::move(cut)), {.box = kBox, .voxelSize = 0.07});
}

/// Without bounds the surface is followed from block to block.
TEST(SimplifiedFields, MeshIsThatOfThePlainFieldWithoutBounds) {
  std::vector<FieldPtr> parts = lattice(4);
  parts.push_back(functionField({.value = [](const Vec3d& p) { return length(p - Vec3d{0.3, 0.2, 0.1}) - 0.4; }}));
  expectSameMesh(unite(std::move(parts)), {.box = kBox, .voxelSize = 0.07});
}

/// Difference quotients look beyond the block.
TEST(SimplifiedFields, MeshIsThatOfThePlainFieldWithoutGradients) {
  std::vector<FieldPtr> parts;
  for (int i = 0; i < 20; ++i) parts.push_back(std::make_shared<SlopelessSphere>(Vec3d{0.1 * i - 1, 0.01 * i, 0}, 0.2));
  expectSameMesh(unite(std::move(parts)), {.box = kBox, .voxelSize = 0.04});
}

/// An operand that never decides may be missing all the same.
TEST(SimplifiedFields, ErrorIsThatOfThePlainField) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const FieldPtr missing =
      functionField({.value = [](const Vec3d& p) { return p.x > 0.15 ? kNan : length(p) - 9; }, .lipschitz = 1.0});
  const auto message = [](const FieldPtr& field) -> std::string {
    try {
      (void)contour(FieldSource(field, {.box = kBox, .voxelSize = 0.07}), {});
      return "";
    } catch (const Error& e) {
      return e.what();
    }
  };
  const FieldPtr cut = intersect({unite(lattice(4)), missing});
  EXPECT_NE(message(cut), "");
  EXPECT_EQ(message(cut), message(std::make_shared<PlainField>(cut)));
}

SimplifiedFields fieldsOf(FieldPtr field) { return {std::move(field), {kBox.lo, 2.0 / 64}, {8, 8, 8}}; }

TEST(SimplifiedFields, FewPartsAreTakenAsTheyAre) {
  const FieldPtr few = unite({sphere({0, 0, 0}, 1), sphere({0.5, 0, 0}, 1)});
  EXPECT_EQ(&*fieldsOf(few).in({1, 2, 3}, 0), few.get());
}

TEST(SimplifiedFields, BlocksHaveThePartsNearThem) {
  const FieldPtr parts = unite(lattice(8));
  const SimplifiedFields fields = fieldsOf(parts);
  EXPECT_EQ(fields.in({0, 0, 0}, 3)->parts(), parts->parts());
  std::size_t last = parts->parts();
  for (int level = 2; level >= 0; --level) {
    const LocalField field = fields.in({3 >> level, 3 >> level, 3 >> level}, level);
    EXPECT_LT(field->parts(), last);
    last = field->parts();
  }
  EXPECT_LT(last, 30u);
}

TEST(SimplifiedFields, CubesBeyondTheLatticeHaveTheWhole) {
  const FieldPtr parts = unite(lattice(8));
  const SimplifiedFields fields = fieldsOf(parts);
  for (const Coord& cube : {Coord{-1, 0, 0}, Coord{0, 8, 0}, Coord{0, 0, 100}})
    EXPECT_EQ(&*fields.in(cube, 0), parts.get());
  EXPECT_EQ(&*fields.in({0, 0, 0}, 4), parts.get());
}

TEST(SimplifiedFields, ManyThreadsGetTheSameField) {
  const SimplifiedFields fields = fieldsOf(unite(lattice(6)));
  std::vector<const Field*> found(4096);
  tbb::parallel_for(0, 4096, [&](int i) { found[i] = &*fields.in({i & 3, i >> 2 & 3, i >> 4 & 3}, 1); });
  for (int i = 0; i < 4096; ++i) EXPECT_EQ(found[i], found[i & 63]);
}

}  // namespace
}  // namespace pdc
