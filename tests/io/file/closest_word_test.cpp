#include "io/file/closest_word.h"

#include <gtest/gtest.h>

#include <vector>

namespace pdc::detail {
namespace {

const std::vector<std::string> kKnown{"density", "temperature", "v", "Cd", "sigma", "smooth", "smooth_union"};

TEST(ClosestWord, IsThatOfTheFewestChanges) {
  for (const char* typo : {"densty", "denssity", "dnesity", "demsity", "DENSITY", "dens"})
    EXPECT_EQ(closestWord(typo, kKnown), "density") << typo;
  EXPECT_EQ(closestWord("smoth", kKnown), "smooth");
  EXPECT_EQ(closestWord("smooth_unoin", kKnown), "smooth_union");
  EXPECT_EQ(closestWord("cd", kKnown), "Cd");
}

TEST(ClosestWord, IsNothingWhereAllAreFar) {
  EXPECT_EQ(closestWord("pressure", kKnown), "");
  EXPECT_EQ(closestWord("density", {}), "");
  EXPECT_EQ(didYouMean("pressure", kKnown), "");
  EXPECT_EQ(didYouMean("sgima", kKnown), " (did you mean 'sigma'?)");
}

}  // namespace
}  // namespace pdc::detail
