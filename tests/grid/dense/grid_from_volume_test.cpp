#include "pdc/grid/grid_from_volume.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "pdc/error.h"

namespace pdc {
namespace {

TEST(GridFromVolume, ValuesStandWhereTheViewHasThem) {
  const std::vector<std::int16_t> values{1, 2, 3, 4, 5, 6};
  // x runs backwards from the last.
  const VolumeView view{.data = reinterpret_cast<const std::byte*>(&values[5]),
                        .type = ScalarType::kInt16,
                        .size = {3, 2, 1},
                        .stride = {-2, -6, 0},
                        .slope = 0.5,
                        .intercept = 10};
  const auto grid = gridFromVolume(view, Mat3d::diagonal(1, 2, -3), {7, 8, 9}, -1);
  const auto values3 = grid->getConstAccessor();
  EXPECT_EQ(values3.getValue({0, 0, 0}), 13);
  EXPECT_EQ(values3.getValue({2, 0, 0}), 12);
  EXPECT_EQ(values3.getValue({2, 1, 0}), 10.5F);
  EXPECT_EQ(values3.getValue({3, 1, 0}), -1);
  EXPECT_EQ(grid->activeVoxelCount(), 6u);
  const openvdb::Vec3d place = grid->indexToWorld(openvdb::Vec3d(1, 1, 1));
  EXPECT_EQ(place, openvdb::Vec3d(8, 10, 6));
}

TEST(GridFromVolume, LeavesAtTheEndsAreFilledInPart) {
  constexpr std::int64_t kSide = 19;
  std::vector<float> values(kSide * kSide * kSide);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  const VolumeView view{.data = reinterpret_cast<const std::byte*>(values.data()),
                        .size = {kSide, kSide, kSide},
                        .stride = {4, 4 * kSide, 4 * kSide * kSide}};
  const auto grid = gridFromVolume(view, Mat3d{}, {}, 0);
  EXPECT_EQ(grid->activeVoxelCount(), values.size());
  EXPECT_EQ(grid->getConstAccessor().getValue({18, 17, 16}), values[18 + 19 * 17 + 361 * 16]);
}

TEST(GridFromVolume, HalfFloatsAndTurnedBytes) {
  const std::vector<std::uint16_t> halves{0x3c00, 0xc000};
  VolumeView view{.data = reinterpret_cast<const std::byte*>(halves.data()),
                  .type = ScalarType::kFloat16,
                  .size = {2, 1, 1},
                  .stride = {2, 4, 4}};
  EXPECT_EQ(gridFromVolume(view, Mat3d{}, {}, 0)->getConstAccessor().getValue({1, 0, 0}), -2);
  view.type = ScalarType::kUint16;
  view.swapped = true;
  EXPECT_EQ(gridFromVolume(view, Mat3d{}, {}, 0)->getConstAccessor().getValue({1, 0, 0}), 0x00c0);
}

TEST(GridFromVolume, RefusesWhatIsNoVolume) {
  EXPECT_THROW(static_cast<void>(gridFromVolume({}, Mat3d{}, {}, 0)), Error);
  EXPECT_THROW(static_cast<void>(gridFromVolume({.size = {1, 1, 1}}, Mat3d{}, {}, 0)), std::invalid_argument);
  const float value = 1;
  VolumeView view{.data = reinterpret_cast<const std::byte*>(&value), .size = {1, 1, 1}};
  view.size[0] = std::int64_t{1} << 31;
  EXPECT_THROW(static_cast<void>(gridFromVolume(view, Mat3d{}, {}, 0)), Error);
  view.size[0] = 1;
  const std::atomic<bool> stop = true;
  EXPECT_THROW(static_cast<void>(gridFromVolume(view, Mat3d{}, {}, 0, {.stop = &stop})), Cancelled);
}

}  // namespace
}  // namespace pdc
