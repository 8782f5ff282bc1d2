#include "extract/certify/crease_moves.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "extract/certify/brute_force.h"
#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

/// A solid whose creases fold.
class CreaseMovesTest : public testing::Test {
 protected:
  CreaseMovesTest() { mConflicts = mNear.findConflicts(mActive); }

  const FieldSource mSource = creasedSolid(24);
  std::atomic<bool> mStop{false};
  const Monitor mMonitor{.progress = {}, .stop = &mStop};
  UncertifiedMesh mInput{mSource, 0, mMonitor};
  const std::vector<EdgeRef> mActive = mInput.active();
  NearFaces mNear{mInput.working.faces(), mInput.progress};
  std::vector<Conflict> mConflicts;
};

TEST_F(CreaseMovesTest, EachMoveLeavesItsVertexFewerConflicts) {
  ASSERT_FALSE(mConflicts.empty());
  BruteForce bruteForce(mInput);
  const std::vector<VertexMove> moves = findCreaseMoves(mInput.working, mNear, mConflicts);
  ASSERT_FALSE(moves.empty());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const VertexMove& m = moves[i];
    EXPECT_TRUE(i == 0 || moves[i - 1].vertex < m.vertex);
    const VertexState& v = mInput.working.vertices()[m.vertex];
    EXPECT_NE(v.creaseNormals[1], Vec3f{}) << "it is not on a crease";
    const auto vertex = static_cast<std::uint32_t>(v.vertex);
    const BruteForce::Count before = bruteForce.countConflicts(vertex, mInput.mesh.positions[vertex]),
                            after = bruteForce.countConflicts(vertex, mInput.working.faces().worldPosition(v, m.place));
    EXPECT_LT(after.least, before.most) << "vertex " << m.vertex;
  }
}

TEST_F(CreaseMovesTest, NoTwoMovesShareAConflict) {
  const std::vector<VertexMove> moves = findCreaseMoves(mInput.working, mNear, mConflicts);
  std::set<std::uint64_t> moved;
  for (const VertexMove& m : moves) moved.insert(mInput.working.vertices()[m.vertex].vertex);
  for (const Conflict& c : mConflicts) {
    std::set<std::uint32_t> corners;
    forEachCorner(c, [&](std::uint32_t v) { corners.insert(v); });
    EXPECT_LE(std::count_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return moved.contains(v); }), 1);
  }
}

TEST_F(CreaseMovesTest, VerticesMoveAFewTimesAtMost) {
  for (VertexState& v : mInput.working.vertices()) v.creaseMoves = 3;
  EXPECT_TRUE(findCreaseMoves(mInput.working, mNear, mConflicts).empty());
}

TEST_F(CreaseMovesTest, FullyRetractedVerticesDoNotMove) {
  for (std::size_t i = 0; i < mInput.working.vertices().size(); ++i) mInput.working.retract(i, 8);
  ASSERT_TRUE(WorkingMesh::fullyRetracted(mInput.working.vertices()[0]));
  EXPECT_TRUE(findCreaseMoves(mInput.working, mNear, mConflicts).empty());
}

TEST_F(CreaseMovesTest, FacesFoldedByNoiseAreLeftAlone) {
  const std::vector<Conflict> many(mInput.mesh.quads.size() / 20 + 201, mConflicts.front());
  EXPECT_TRUE(findCreaseMoves(mInput.working, mNear, many).empty());
}

TEST_F(CreaseMovesTest, BetterPlacesAreWithoutConflictAndNearerToThePlanes) {
  for (std::size_t i = 0; i < mInput.working.vertices().size(); ++i)
    for (int step = 0; step < 5; ++step) mInput.working.retract(i);
  (void)mNear.findConflicts(mActive);
  const std::vector<VertexMove> moves = findBetterPlaces(mInput.working, mNear);
  ASSERT_FALSE(moves.empty());
  BruteForce bruteForce(mInput);
  for (const VertexMove& m : moves) {
    const VertexState& v = mInput.working.vertices()[m.vertex];
    const Mat3d M = mSource.map().jacobian({});
    const auto distance = [&](const Vec3f& place) {
      double most = 0;
      for (const Vec3f& n : v.creaseNormals)
        most = std::max(most, std::abs(dot(vecCast<double>(n), M * vecCast<double>(place - v.wanted))));
      return most;
    };
    EXPECT_LT(distance(m.place), distance(v.place));
    const Vec3f world = mInput.working.faces().worldPosition(v, m.place);
    EXPECT_EQ(bruteForce.countConflicts(static_cast<std::uint32_t>(v.vertex), world).least, 0U);
  }
}

TEST_F(CreaseMovesTest, BothSearchesStopWhenAsked) {
  for (std::size_t i = 0; i < mInput.working.vertices().size(); i += 10) mInput.working.retract(i);
  mStop = true;
  EXPECT_THROW((void)findCreaseMoves(mInput.working, mNear, mConflicts), Cancelled);
  EXPECT_THROW((void)findBetterPlaces(mInput.working, mNear), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
