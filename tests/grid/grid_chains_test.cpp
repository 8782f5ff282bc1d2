#include "eval/grid_chains.h"

#include <gtest/gtest.h>

namespace pdc::eval {
namespace {

TEST(GridChains, EndWithAManifoldOrALine) {
  int taken = 0, steps = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    const ChainOutcome outcome = runRandomChain(seed);
    EXPECT_EQ(outcome.fault, "") << seed << ": " << outcome.what;
    steps += outcome.steps;
    taken += outcome.refusal.empty() ? 1 : 0;
  }
  EXPECT_GT(steps, 24);
  EXPECT_GT(taken, 4);
}

}  // namespace
}  // namespace pdc::eval
