#include "pdc/tile/slab_plan.h"

#include <gtest/gtest.h>

#include <numeric>

#include "pdc/error.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

FieldSource ball(double voxelSize) {
  return {sphere({}, 0.9), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = voxelSize}};
}

std::uint64_t sumOf(const SlabPlan& plan) {
  return std::accumulate(plan.slabs.begin(), plan.slabs.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Slab& s) { return sum + s.vertices; });
}

void expectOneBesideTheOther(const SlabPlan& plan) {
  for (const Slab& s : plan.slabs) EXPECT_LT(s.begin, s.end);
  for (std::size_t i = 1; i < plan.slabs.size(); ++i) EXPECT_EQ(plan.slabs[i - 1].end, plan.slabs[i].begin);
}

TEST(SlabPlan, SlabsHaveAllVerticesInAboutEqualShares) {
  const FieldSource source = ball(2.0 / 128);  // Sixteen layers.
  const std::uint64_t all = contour(source).positions.size();
  for (const int count : {1, 2, 3, 5}) {
    const SlabPlan plan = planSlabs(source, {}, {.slabs = count});
    ASSERT_EQ(plan.slabs.size(), static_cast<std::size_t>(count));
    expectOneBesideTheOther(plan);
    EXPECT_EQ(sumOf(plan), all);
    for (const Slab& s : plan.slabs)
      EXPECT_NEAR(static_cast<double>(s.vertices), double(all) / count, 0.09 * double(all));
  }
}

TEST(SlabPlan, ThereAreNoMoreSlabsThanLayers) {
  const FieldSource source = ball(2.0 / 128);
  const SlabPlan plan = planSlabs(source, {}, {.slabs = 1000});
  EXPECT_EQ(plan.slabs.size(), 16U);
  expectOneBesideTheOther(plan);
  EXPECT_EQ(sumOf(plan), contour(source).positions.size());
}

TEST(SlabPlan, LayersWithoutSurfaceBetweenOthersArePartOfASlab) {
  const FieldPtr two = unite({sphere({-0.8, 0, 0}, 0.1), sphere({0.8, 0, 0}, 0.1)});
  const FieldSource source(two, {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 2.0 / 256});
  const SlabPlan plan = planSlabs(source, {}, {.slabs = 8});
  EXPECT_EQ(plan.slabs.size(), 8U);
  expectOneBesideTheOther(plan);
  EXPECT_EQ(sumOf(plan), contour(source).positions.size());
}

TEST(SlabPlan, WithoutSurfaceThereAreNoSlabs) {
  const FieldSource source(sphere({9, 9, 9}, 0.5), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 0.1});
  EXPECT_TRUE(planSlabs(source, {}, {.slabs = 3}).slabs.empty());
}

TEST(SlabPlan, LessMemoryMakesMoreSlabs) {
  const FieldSource source = ball(2.0 / 400);
  EXPECT_EQ(planSlabs(source, {}, {}).slabs.size(), 1U);
  const std::size_t inUse = planSlabs(source, {}, {.maxMemory = std::size_t{4} << 30}).slabs.size();
  EXPECT_EQ(inUse, 1U);
  try {
    (void)planSlabs(source, {}, {.maxMemory = 1000});
    FAIL() << "a kilobyte is enough";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a slab of one layer"), std::string::npos) << error.what();
  }
}

TEST(SlabPlan, TheOriginIsThatOfTheWhole) {
  const FieldPtr far = sphere({1e7, 0, 0}, 0.9);
  const FieldSource source(far, {.box = {{1e7 - 1, -1, -1}, {1e7 + 1, 1, 1}}, .voxelSize = 0.05});
  const ContourOptions options{.origin = std::nullopt};
  EXPECT_EQ(planSlabs(source, options, {.slabs = 2}).origin, contour(source, options).origin);
  EXPECT_NE(planSlabs(source, options, {.slabs = 2}).origin, Vec3d{});
}

TEST(SlabPlan, OptionsOfWholeMeshesAreRefused) {
  EXPECT_THROW((void)planSlabs(ball(0.1), {.adaptive = 0.1}, {}), std::invalid_argument);
  EXPECT_THROW((void)planSlabs(ball(0.1), {}, {.slabs = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
