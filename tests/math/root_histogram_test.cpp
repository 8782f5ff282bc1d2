#include "math/root_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace pdc::detail {
namespace {

TEST(RootHistogram, FindsTheMedianWithinATenth) {
  std::mt19937 engine(3);
  std::lognormal_distribution<float> random(-3, 1);
  RootHistogram histogram;
  std::vector<float> all;
  for (int i = 0; i < 1001; ++i) {
    all.push_back(random(engine));
    histogram.count(RootHistogram::bin(all.back() * all.back()));
  }
  std::nth_element(all.begin(), all.begin() + 500, all.end());
  EXPECT_EQ(histogram.total(), 1001);
  EXPECT_NEAR(histogram.median() / double{all[500]}, 1, 0.1);
}

TEST(RootHistogram, CountsZerosThatAreAdded) {
  RootHistogram histogram;
  EXPECT_EQ(histogram.median(), 0);
  for (int i = 0; i < 4; ++i) histogram.count(RootHistogram::bin(0.25F));
  EXPECT_NEAR(histogram.median(), 0.5, 0.1);
  EXPECT_NEAR(histogram.median(2), 0.5, 0.1);
  EXPECT_EQ(histogram.median(4), 0);
}

TEST(RootHistogram, TakesNumbersOfAnySize) {
  RootHistogram histogram;
  for (const float squared : {0.0F, 1e-30F, 1e30F}) {
    EXPECT_GE(RootHistogram::bin(squared), 0);
    EXPECT_LT(RootHistogram::bin(squared), RootHistogram::kBins);
    histogram.count(RootHistogram::bin(squared));
  }
  EXPECT_EQ(histogram.median(), 0);
}

TEST(RootHistogram, AddsUp) {
  RootHistogram a, b;
  a.count(RootHistogram::bin(0.01F));
  for (int i = 0; i < 3; ++i) b.count(RootHistogram::bin(1.0F));
  a += b;
  EXPECT_EQ(a.total(), 4);
  EXPECT_NEAR(a.median(), 1, 0.1);
}

}  // namespace
}  // namespace pdc::detail
