#include "sample/creases/surface_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace pdc::detail {
namespace {

/// A sample is known by its first column; the others are made of it.
struct Sample {
  float name, support;
  bool operator==(const Sample&) const = default;
};
using Row = std::vector<std::vector<Sample>>;  // By voxel.

/// Up to eight samples per voxel; some have no support, some the same.
Row randomRow(std::mt19937& random) {
  std::uniform_int_distribution<int> count(0, kOctants), tenth(0, 9);
  Row row(VoxelSamples::kVoxels);
  float name = 1;
  for (auto& voxel : row) {
    voxel.resize(tenth(random) < 3 ? 0 : static_cast<std::size_t>(count(random)));
    for (Sample& s : voxel) s = {name++, tenth(random) < 4 ? 0.0F : 0.1F * static_cast<float>(1 + tenth(random))};
  }
  return row;
}

void write(const Row& samples, int row, VoxelSamples& to) {
  for (int v = 0; v < VoxelSamples::kVoxels; ++v) {
    to.start[row][v] = static_cast<std::uint16_t>(to.count);
    for (const Sample& s : samples[v]) {
      for (int c = 0; c < SurfaceSamples::kColumns; ++c) to.column[c][to.count] = s.name * static_cast<float>(c + 1);
      to.column[SurfaceSamples::kSupport][to.count] = s.support;
      to.column[SurfaceSamples::kFitWeight][to.count++] = 0.5F * s.support;
    }
  }
  to.start[row][VoxelSamples::kVoxels] = static_cast<std::uint16_t>(to.count);
}

Row read(const VoxelSamples& from, int row) {
  Row samples(VoxelSamples::kVoxels);
  for (int v = 0; v < VoxelSamples::kVoxels; ++v)
    for (int i = from.start[row][v]; i < from.start[row][v + 1]; ++i) {
      const Sample s{from.column[0][i], from.column[SurfaceSamples::kSupport][i]};
      samples[v].push_back(s);
      for (int c = 0; c < SurfaceSamples::kSupport; ++c)
        EXPECT_EQ(from.column[c][i], s.name * static_cast<float>(c + 1));
      EXPECT_EQ(from.column[SurfaceSamples::kFitWeight][i], 0.5F * s.support);
    }
  return samples;
}

/// Removes the samples without support, then, while there are more than three, the first of those with the least.
Row supported(Row row) {
  for (auto& voxel : row) {
    std::erase_if(voxel, [](const Sample& s) { return s.support == 0; });
    while (voxel.size() > 3)
      voxel.erase(std::min_element(voxel.begin(), voxel.end(),
                                   [](const Sample& a, const Sample& b) { return a.support < b.support; }));
  }
  return row;
}

TEST(VoxelSamples, KeepThreeWithSupportPerVoxel) {
  std::mt19937 random(2);
  std::size_t dropped = 0;
  for (int round = 0; round < 200; ++round) {
    const auto samples = std::make_unique<VoxelSamples>();
    const std::array<Row, 3> rows{randomRow(random), randomRow(random), randomRow(random)};
    for (int r = 0; r < 3; ++r) write(rows[r], r, *samples);
    samples->keepSupported(1);
    ASSERT_EQ(read(*samples, 0), rows[0]);
    ASSERT_EQ(read(*samples, 1), supported(rows[1]));
    ASSERT_EQ(read(*samples, 2), rows[2]);
    dropped += supported(rows[1]) != rows[1];
  }
  EXPECT_GT(dropped, 100u);
}

TEST(VoxelSamples, StayWhereTheyAreIfAllAreSupported) {
  const auto samples = std::make_unique<VoxelSamples>();
  const Row row(VoxelSamples::kVoxels, {{1, 0.5F}, {2, 0.5F}});
  write(row, 0, *samples);
  samples->keepSupported(0);
  EXPECT_EQ(read(*samples, 0), row);
}

}  // namespace
}  // namespace pdc::detail
