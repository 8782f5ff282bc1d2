#include "pdc/sample/normal_noise.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>

#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"
#include "sample/creases/noisy_part.h"
#include "sample/watched_source.h"

namespace pdc {
namespace {

FieldSource sourceOf(const FieldPtr& field) { return {field, {.box = test::kDrilledBoxBounds, .voxelSize = 0.05}}; }

TEST(NormalNoise, IsZeroOnFlatFacesWhateverTheCreases) {
  EXPECT_EQ(normalNoise(sourceOf(box({0, 0, 0}, {1, 1, 0.5}))), 0);
}

// The gradient of values with independent errors: about proportional to them while they are small.
TEST(NormalNoise, GrowsWithTheNoiseOfTheValues) {
  double last = 0;
  for (const double noise : {0.02, 0.05, 0.1, 0.2}) {
    const double found = normalNoise(GridSource(test::noisyLevelSet(0.05, noise, 3)));
    EXPECT_GT(found, last);
    EXPECT_NEAR(found / noise, 0.68, 0.15);
    last = found;
  }
}

TEST(NormalNoise, StopEndsItWithinABlock) {
  std::atomic<bool> stop = false;
  std::atomic<int> blocks = 0;
  // Thousands of blocks, so that a thread's share of them is many.
  const FieldSource source(box({0, 0, 0}, {1, 1, 0.5}), {.box = test::kDrilledBoxBounds, .voxelSize = 0.01});
  const test::WatchedSource watched(source, {.hermite = [&] {
                                      ++blocks;
                                      stop = true;
                                    }});
  const Monitor monitor{.stop = &stop};
  const auto estimate = [&] { static_cast<void>(normalNoise(watched, monitor)); };
  EXPECT_THROW(tbb::task_arena(1).execute(estimate), Cancelled);
  EXPECT_EQ(blocks, 1);
}

}  // namespace
}  // namespace pdc
