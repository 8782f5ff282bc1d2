#include "study/whole_progress.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pdc::detail {
namespace {

/// What a monitor of the whole hears.
struct Heard {
  std::vector<std::string> stages;
  std::vector<double> shares;

  Monitor monitor() {
    return {.progress = [this](const char* stage, double share) {
      stages.emplace_back(stage);
      shares.push_back(share);
    }};
  }
};

TEST(WholeProgress, PartsFollowEachOtherAndStagesShareAPart) {
  Heard heard;
  const Monitor whole = heard.monitor();
  WholeProgress progress(whole, 2);
  const Monitor first = progress.beginPart();
  first.progress("count", 0.5);
  first.progress("count", 1);
  first.progress("solve", 0);
  first.progress("solve", 1);
  const Monitor second = progress.beginPart();
  second.progress("solve", 1);
  progress.finish();
  EXPECT_EQ(heard.shares, (std::vector<double>{0.125, 0.25, 0.375, 0.75, 1}));
  EXPECT_EQ(heard.stages, (std::vector<std::string>{"count", "count", "solve", "solve", "done"}));
}

TEST(WholeProgress, NeverFallsWhenAPartStartsAgain) {
  Heard heard;
  const Monitor whole = heard.monitor();
  WholeProgress progress(whole, 1);
  const Monitor part = progress.beginPart();
  for (const double share : {0.8, 0.2, 0.9, 2.0, -1.0}) part.progress("same", share);
  EXPECT_EQ(heard.shares, (std::vector<double>{0.4, 0.45, 0.5}));
}

TEST(WholeProgress, IsHeardInOrderFromManyThreads) {
  Heard heard;
  const Monitor whole = heard.monitor();
  WholeProgress progress(whole, 3);
  for (int i = 0; i < 3; ++i) {
    const Monitor part = progress.beginPart();
    tbb::parallel_for(0, 10'000, [&](int k) { part.progress("solve", k / 10'000.0); });
  }
  progress.finish();
  EXPECT_GT(heard.shares.size(), 10u);
  EXPECT_TRUE(std::is_sorted(heard.shares.begin(), heard.shares.end()));
  EXPECT_EQ(heard.shares.back(), 1);
}

TEST(WholeProgress, StopsBetweenParts) {
  std::atomic<bool> stop = false;
  const Monitor whole{.stop = &stop};
  WholeProgress progress(whole, 2);
  const Monitor part = progress.beginPart();
  EXPECT_EQ(part.stop, &stop);
  EXPECT_FALSE(part.progress);
  stop = true;
  EXPECT_THROW(static_cast<void>(progress.beginPart()), Cancelled);
  EXPECT_THROW(progress.finish(), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
