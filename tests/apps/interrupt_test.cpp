#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

// Far more cells than can be contoured in the time before the signal.
Arguments longWork(const TemporaryFolder& folder) {
  return {"mesh", sourceFolder() / "scenes/csg.yaml", folder / "out.ply", "--quiet", "--resolution", "4000"};
}

TEST(Interrupt, StopsWithinASecondAndLeavesNothing) {
  const TemporaryFolder folder;
  const Outcome outcome = runPdc(longWork(folder), {.interruptAfter = 0.3});
  EXPECT_EQ(outcome.exitCode, 130);
  EXPECT_LT(outcome.secondsAfterSignal, 1.0);
  EXPECT_EQ(outcome.err, "pdc: interrupted\n");
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Interrupt, KeepsWhatStoodUnderTheName) {
  const TemporaryFolder folder;
  const auto output = folder.write("out.ply", "an older mesh");
  EXPECT_EQ(runPdc(longWork(folder), {.interruptAfter = 0.3}).exitCode, 130);
  EXPECT_EQ(readFile(output), "an older mesh");
  EXPECT_EQ(folder.entries().size(), 1U);
}

// A pipe that nobody reads holds the program up in the middle of writing.
TEST(Interrupt, EndsAtOnceWhileWriting) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "out.ply";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Outcome outcome = runPdc({"mesh", bulletGrid(), pipe}, {.interruptAfter = 0.5});
  EXPECT_EQ(outcome.exitCode, 130);
  EXPECT_LT(outcome.secondsAfterSignal, 1.0);
  EXPECT_EQ(folder.entries().size(), 1U);
}

}  // namespace
}  // namespace pdc::test
