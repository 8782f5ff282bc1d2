// Steps on grids by `pdc grid` beside the same by OpenVDB's vdb_tool: equal voxels. Skipped where that is not
// installed.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cstddef>
#include <cstdlib>
#include <string>

#include "apps/program.h"
#include "pdc/io/vdb/vdb_reader.h"

namespace pdc::test {
namespace {

using openvdb::FloatGrid;

bool runVdbTool(const std::string& actions) {
  return std::system(("vdb_tool " + actions + " > /dev/null 2>&1").c_str()) == 0;
}

/// Two balls on the same lattice, the second beside the first.
class VdbTool : public testing::Test {
 protected:
  void SetUp() override {
    if (!runVdbTool("-sphere voxel=0.04 radius=0.8 -write vdb=0 " + path("first.vdb")))
      GTEST_SKIP() << "vdb_tool is not installed";
    ASSERT_TRUE(runVdbTool("-sphere voxel=0.04 radius=0.6 'center=(0.7,0,0)' -write vdb=0 " + path("second.vdb")));
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (mFolder / name).string(); }

  [[nodiscard]] FloatGrid::Ptr grid(const std::string& name) const {
    return openvdb::gridPtrCast<FloatGrid>(readVdbGrid(path(name)));
  }

  /// Expects that steps make of the first ball what the actions do, and something else than it was.
  void expectSame(const Arguments& steps, const std::string& actions) {
    SCOPED_TRACE(actions);
    Arguments line{"grid", path("first.vdb"), path("ours.vdb"), "--quiet"};
    line.insert(line.end(), steps.begin(), steps.end());
    const Outcome outcome = runPdc(line);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    ASSERT_TRUE(runVdbTool("-read " + path("first.vdb") + " " + actions + " -write vdb=0 " + path("theirs.vdb")));
    const FloatGrid::Ptr ours = grid("ours.vdb"), theirs = grid("theirs.vdb"), first = grid("first.vdb");
    ASSERT_TRUE(ours && theirs && first);
    EXPECT_EQ(differences(*ours, *theirs), 0u);
    EXPECT_GT(differences(*ours, *first), 0u);
  }

 private:
  /// Voxels of another value or another state.
  static std::size_t differences(const FloatGrid& a, const FloatGrid& b) {
    openvdb::CoordBBox box = a.evalActiveVoxelBoundingBox();
    box.expand(b.evalActiveVoxelBoundingBox());
    std::size_t different = 0;
    const auto left = a.getConstAccessor(), right = b.getConstAccessor();
    for (const openvdb::Coord& c : box)
      if (left.getValue(c) != right.getValue(c) || left.isValueOn(c) != right.isValueOn(c)) ++different;
    return different;
  }

  TemporaryFolder mFolder;
};

TEST_F(VdbTool, FiltersMakeTheSameVoxels) {
  expectSame({"--smooth", "mean:0.08"}, "-mean size=2 iter=1");
  expectSame({"--smooth", "gaussian:0.04"}, "-gauss size=1 iter=1");
  expectSame({"--smooth", "median:0.04"}, "-median size=1 iter=1");
}

TEST_F(VdbTool, MovesMakeTheSameVoxels) {
  expectSame({"--offset", "0.08"}, "-dilate radius=2");
  expectSame({"--offset", "-0.12"}, "-erode radius=3");
  expectSame({"--open-close", "0.08"}, "-open radius=2 -close radius=2");
}

TEST_F(VdbTool, CombinationsMakeTheSameVoxels) {
  const std::string second = path("second.vdb");
  expectSame({"--union", second}, "-read " + second + " -union vdb=1,0 rebuild=false");
  expectSame({"--intersect", second}, "-read " + second + " -intersection vdb=1,0 rebuild=false");
  expectSame({"--subtract", second}, "-read " + second + " -difference vdb=1,0 rebuild=false");
}

TEST_F(VdbTool, ChainsMakeTheSameVoxels) {
  const std::string second = path("second.vdb");
  expectSame({"--clip", "-0.5,-2,-2,0.3,2,2", "--open"}, "-clip 'bbox=(-0.5,-2,-2),(0.3,2,2)'");
  expectSame({"--smooth", "mean:0.04", "--offset", "0.08"}, "-mean size=1 iter=1 -dilate radius=2");
  expectSame({"--smooth", "median:0.04", "--offset", "-0.04", "--union", second},
             "-median size=1 iter=1 -erode radius=1 -read " + second + " -union vdb=1,0 rebuild=false");
  expectSame({"--offset", "0.04", "--subtract", second},
             "-dilate radius=1 -read " + second + " -difference vdb=1,0 rebuild=false");
}

}  // namespace
}  // namespace pdc::test
