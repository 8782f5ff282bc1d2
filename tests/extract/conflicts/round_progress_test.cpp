#include "extract/conflicts/round_progress.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <vector>

namespace pdc::detail {
namespace {

TEST(RoundProgress, NeverGoesBackAndEndsAtOne) {
  std::vector<double> shares;
  // Calls are not concurrent: they come under a lock.
  const Monitor monitor{.progress = [&](const char* stage, double share) {
    EXPECT_STREQ(stage, "stage");
    shares.push_back(share);
  }};
  RoundProgress progress(monitor, "stage");
  for (int round = 0; round < 100; ++round) {
    progress.beginRound(5000);
    tbb::parallel_for(0, 5000, [&](int) { progress.advance(); });
  }
  progress.finish();
  ASSERT_GT(shares.size(), 1000U);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
  for (std::size_t i = 1; i < shares.size(); ++i) ASSERT_LE(shares[i - 1], shares[i]);
}

TEST(RoundProgress, EachRoundIsHalfOfWhatIsLeft) {
  double last = -1;
  const Monitor monitor{.progress = [&](const char*, double share) { last = share; }};
  RoundProgress progress(monitor, "stage");
  for (const double begin : {0.0, 0.5, 0.75, 0.875}) {
    progress.beginRound(512);
    EXPECT_EQ(last, begin);
    for (int i = 0; i < 256; ++i) progress.advance();
    EXPECT_EQ(last, begin + 0.25 * (1 - begin));
  }
}

TEST(RoundProgress, ThrowsWhenStopped) {
  std::atomic<bool> stop{false};
  const Monitor monitor{.progress = {}, .stop = &stop};
  RoundProgress progress(monitor, "stage");
  progress.beginRound(2);
  progress.advance();
  stop = true;
  EXPECT_THROW(progress.advance(), Cancelled);
  EXPECT_THROW(progress.beginRound(2), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
