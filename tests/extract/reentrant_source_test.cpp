// Sources whose functions run parallel loops of their own, as a field that uses TBB does.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "pdc/extract/contour.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/normal_noise.h"
#include "pdc/sample/sampled_source.h"
#include "sample/wrapped_source.h"

namespace pdc {
namespace {

/// Notes whether a thread that is in fillHermite() enters it again.
class ReentrantSource final : public WrappedSource {
 public:
  using WrappedSource::WrappedSource;

  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override {
    thread_local int depth = 0;
    if (++depth > 1) mEntered = true;
    tbb::parallel_for(0, 8, [](int) { std::this_thread::sleep_for(std::chrono::microseconds(50)); });
    WrappedSource::fillHermite(block, hermite);
    --depth;
  }
  [[nodiscard]] bool entered() const { return mEntered; }

 private:
  mutable std::atomic<bool> mEntered = false;
};

class ReentrantSourceTest : public testing::Test {
 protected:
  // More threads than blocks keep busy, so that some help others and have these wait.
  const tbb::global_control mEightThreads{tbb::global_control::max_allowed_parallelism, 8};
  tbb::task_arena mArena{8};
  const FieldSource mSphere{sphere({}, 0.8), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 2.0 / 160}};
  const ReentrantSource mSource{mSphere};
};

TEST_F(ReentrantSourceTest, AThreadThatWaitsInASourceBeginsNoOtherBlock) {
  ContourReport report;
  const Mesh mesh = contour(mSource, {.sigmaNormal = {}, .confidence = true, .quadrics = true, .threads = 8}, &report);
  EXPECT_GT(report.blocks, 100u);
  EXPECT_FALSE(mSource.entered());
  EXPECT_EQ(mesh.positions, contour(mSphere, {.sigmaNormal = {}}).positions);
}

TEST_F(ReentrantSourceTest, NorWhenSamplesAreKept) {
  std::size_t crossings = 0;
  mArena.execute([&] { crossings = SampledSource(mSource).crossings(); });
  EXPECT_GT(crossings, 1000u);
  EXPECT_FALSE(mSource.entered());
}

TEST_F(ReentrantSourceTest, NorWhenNoiseIsLookedFor) {
  double noise = 1;
  mArena.execute([&] { noise = normalNoise(mSource); });
  EXPECT_LT(noise, 1e-3);  // Its normals are exact.
  EXPECT_FALSE(mSource.entered());
}

}  // namespace
}  // namespace pdc
