#include "sample/vdb/grid_sampler.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <memory>

namespace pdc::detail {
namespace {

constexpr float kHalfWidth = 3, kIso = 0.25F;

class GridSamplerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  const openvdb::FloatGrid::Ptr mGrid =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(10, openvdb::Vec3f(0.3F, -0.2F, 0.1F), 1, kHalfWidth);
  const std::unique_ptr<const GridSampler> mSampler =
      makeGridSampler(mGrid, {.iso = double{kIso}, .clamp = double{kHalfWidth}});
};

TEST_F(GridSamplerTest, DistancesAreReadInTheRowsThatAreAskedForOnly) {
  constexpr float kUntouched = 77, kScale = 0.5F;
  constexpr int kReach = DistanceStencil::kReach;
  // Leaves, and a block of tiles beside them.
  for (const Coord& block : {Coord{0, 0, 0}, Coord{-1, 0, 1}, Coord{-2, -2, -2}, Coord{5, 0, 0}}) {
    const auto stencil = std::make_unique<DistanceStencil>();
    stencil->value.fill(kUntouched);
    for (int x = 0; x < DistanceStencil::kPoints; ++x)
      stencil->rows[x] = static_cast<std::uint16_t>(x % 4 == 1 ? 0 : 0x5A3C >> x % 3 & 0x7FFF);
    mSampler->readDistances(block, kScale, *stencil);
    int known = 0, unknown = 0;
    for (int x = -kReach; x < kBlockPoints + kReach; ++x)
      for (int y = -kReach; y < kBlockPoints + kReach; ++y)
        for (int z = -DistanceStencil::kBelow; z < kBlockSize + DistanceStencil::kAbove; ++z) {
          const float value = stencil->value[DistanceStencil::index(x, y, z)];
          if ((stencil->rows[x + kReach] >> (y + kReach) & 1) == 0) {
            ASSERT_EQ(value, kUntouched) << x << ' ' << y << ' ' << z;
            continue;
          }
          const float stored = mGrid->tree().getValue({8 * block[0] + x, 8 * block[1] + y, 8 * block[2] + z});
          if (std::abs(stored) < kHalfWidth - 1e-4F) {
            ASSERT_EQ(value, (stored - kIso) * kScale) << x << ' ' << y << ' ' << z;
            ++known;
          } else {
            ASSERT_TRUE(std::isnan(value)) << x << ' ' << y << ' ' << z;
            ++unknown;
          }
        }
    EXPECT_GT(known + unknown, 1000);
    EXPECT_EQ(known > 0, block[0] != 5);
  }
}

}  // namespace
}  // namespace pdc::detail
