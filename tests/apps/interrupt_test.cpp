#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "apps/grid_files.h"
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

// Their tools look at what stops them now and then only.
TEST(Interrupt, EndsStepsOnGridsAtOnce) {
  const TemporaryFolder folder;
  const std::string in = folder / "ball.vdb";
  writeSphere(in);
  for (const std::string command : {"mesh", "grid"}) {
    const std::string out = folder / (command == "mesh" ? "out.ply" : "out.vdb");
    const Outcome outcome =
        runPdc({command, in, out, "--resample", "0.002", "--smooth", "curvature:0.03", "--keep", "largest", "--quiet"},
               {.interruptAfter = 0.7});
    EXPECT_EQ(outcome.exitCode, 130);
    EXPECT_LT(outcome.secondsAfterSignal, 0.5);
    EXPECT_EQ(outcome.err, "pdc: interrupted\n");
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"ball.vdb"});
  }
}

}  // namespace
}  // namespace pdc::test
