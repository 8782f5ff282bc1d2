#include "sample/normal_noise_histogram.h"

#include <gtest/gtest.h>

#include <memory>

#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"
#include "sample/creases/noisy_part.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

NormalNoiseHistogram of(const HermiteSource& source, SimdLevel level = bestSimdLevel()) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const auto hermite = std::make_unique<HermiteBlock>();
  NormalNoiseHistogram all;
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    const EdgeIndex edges(blocks.signs[i]);
    source.fillHermite({blocks.coords[i], blocks.signs[i], edges}, *hermite);
    all.add(*hermite, edges, matCast<float>(source.map().jacobian({})), level);
  }
  return all;
}

// On a sphere the mean of two normals is perpendicular to the chord, however small it is.
TEST(NormalNoiseHistogram, CurvatureIsNoNoise) {
  for (const double radius : {1.5, 3.0, 10.0}) {
    const FieldSource ball(sphere({0.3, 0.2, 0.1}, radius), {.box = {{-12, -12, -12}, {12, 12, 12}}, .voxelSize = 1});
    const NormalNoiseHistogram found = of(ball);
    EXPECT_GT(found.count(), 10) << radius;
    EXPECT_LT(found.sigma(), 1e-3) << radius;
  }
}

TEST(NormalNoiseHistogram, ALongVoxelChangesNothing) {
  const FieldSource ball(sphere({}, 0.8), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 0.01});
  EXPECT_LT(of(ball).sigma(), 1e-3);
}

TEST(NormalNoiseHistogram, DoesNotDependOnTheProcessor) {
  const GridSource source(test::noisyLevelSet(0.05, 0.1, 3));
  const NormalNoiseHistogram best = of(source);
  for (const SimdLevel level : test::simdLevels()) {
    const NormalNoiseHistogram own = of(source, level);
    EXPECT_EQ(own.count(), best.count());
    EXPECT_EQ(own.sigma(), best.sigma());
  }
}

TEST(NormalNoiseHistogram, FewPairsDoNotTellOfNoise) {
  const GridSource source(test::noisyLevelSet(0.05, 0.1, 3));
  const NormalNoiseHistogram found = of(source);
  EXPECT_GT(found.sigma(), 0.05);
  EXPECT_EQ(found.sigma(found.count()), 0);
  EXPECT_EQ(NormalNoiseHistogram().sigma(), 0);
}

}  // namespace
}  // namespace pdc::detail
