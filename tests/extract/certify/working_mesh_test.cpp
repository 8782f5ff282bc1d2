#include "extract/certify/working_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

class WorkingMeshTest : public testing::Test {
 protected:
  static SignSource grid() {
    std::mt19937 random(31);
    return randomGrid(random, 6, false);
  }
  [[nodiscard]] WorkingMesh& working() { return mInput.working; }
  [[nodiscard]] Vec3f position(std::size_t i) { return mInput.mesh.positions[working().vertices()[i].vertex]; }

  const SignSource mSource = grid();
  std::atomic<bool> mStop{false};
  const Monitor mMonitor{.progress = {}, .stop = &mStop};
  UncertifiedMesh mInput{mSource, 0.02, mMonitor};
};

TEST_F(WorkingMeshTest, RetractingEndsInTheSafePlace) {
  ASSERT_GT(working().vertices().size(), 20U);
  for (std::size_t i = 0; i < working().vertices().size(); ++i) {
    const VertexState& v = working().vertices()[i];
    const auto vertex = static_cast<std::uint32_t>(v.vertex);
    EXPECT_EQ(v.place, v.wanted);
    int steps = 0;
    for (float before = 2; !WorkingMesh::fullyRetracted(v); ++steps) {
      ASSERT_EQ(working().movable(vertex), static_cast<std::ptrdiff_t>(i));
      working().retract(i);
      const float share = length(v.place - v.safe) / length(v.wanted - v.safe);
      ASSERT_TRUE(share < before || v.wanted == v.safe);
      before = share;
      ASSERT_EQ(position(i), working().faces().worldPosition(v, v.place));
    }
    EXPECT_EQ(steps, v.creaseNormals[0] == Vec3f{} ? 5 : 8);
    EXPECT_EQ(v.place, v.safe);
    EXPECT_EQ(working().movable(vertex), -1);
  }
}

TEST_F(WorkingMeshTest, VerticesThatAreNotSuspectAreNotMovable) {
  std::size_t movable = 0;
  for (std::uint32_t v = 0; v < mInput.mesh.positions.size(); ++v) movable += working().movable(v) >= 0;
  EXPECT_EQ(movable, working().vertices().size());
  EXPECT_LT(movable, mInput.mesh.positions.size());
}

TEST_F(WorkingMeshTest, RetractingStartsAgainWhereAVertexIsMoved) {
  const VertexState& v = working().vertices()[0];
  for (int i = 0; i < 3; ++i) working().retract(0);
  const Vec3f place = v.safe + Vec3f{1, 0, 0};
  working().restartAt(0, place);
  EXPECT_EQ(v.place, place);
  EXPECT_EQ(v.retractions, 0);
  EXPECT_EQ(position(0), working().faces().worldPosition(v, place));
  working().retract(0);
  EXPECT_EQ(v.place, v.safe + (place - v.safe) * 0.9F);
}

TEST_F(WorkingMeshTest, QuadsAtVerticesAreThoseThatHaveThem) {
  const std::vector<std::size_t> some{0, 5, 6, 11};
  std::vector<EdgeRef> expected;
  for (const EdgeRef& e : mInput.edges()) {
    const Quad ring = working().edgeCells().vertices(e);
    if (std::any_of(some.begin(), some.end(), [&](std::size_t i) {
          return std::find(ring.begin(), ring.end(), working().vertices()[i].vertex) != ring.end();
        }))
      expected.push_back(e);
  }
  EXPECT_EQ(working().quadsAt(some), expected);
}

TEST_F(WorkingMeshTest, TurningGivesTheOtherDiagonal) {
  const EdgeRef e = mInput.active()[3];
  const Quad& quad = mInput.mesh.quads[working().edgeCells().face(e)];
  const Quad before = quad;
  EXPECT_FALSE(working().turnedBefore(e));
  working().turn({e});
  EXPECT_EQ(quad, (Quad{before[1], before[2], before[3], before[0]}));
  EXPECT_TRUE(working().turnedBefore(e));
  EXPECT_EQ(working().turnCount(), 1U);
}

TEST_F(WorkingMeshTest, FixedQuadsGetADiagonalThatTheirEdgePassesOrBecomeFans) {
  const std::vector<EdgeRef> edges = mInput.edges();
  const auto passes = [&](const EdgeRef& e) {
    return working().faces().passes(e, mInput.mesh.quads[working().edgeCells().face(e)]);
  };
  for (std::size_t i = 0; i < working().vertices().size(); i += 2)
    while (!WorkingMesh::fullyRetracted(working().vertices()[i])) working().retract(i);
  const Buffer<Quad> before = mInput.mesh.quads;
  working().chooseSafeDiagonals(edges);
  std::size_t fixed = 0, turned = 0;
  for (const EdgeRef& e : edges) {
    const std::uint64_t face = working().edgeCells().face(e);
    turned += mInput.mesh.quads[face] != before[face];
    if (!working().fixed(e)) {
      EXPECT_EQ(mInput.mesh.quads[face], before[face]);
      EXPECT_FALSE(working().fans().has(face));
      continue;
    }
    ++fixed;
    EXPECT_NE(passes(e), working().fans().has(face));
  }
  EXPECT_GT(fixed, 20U);
  EXPECT_LT(fixed, edges.size());
  EXPECT_GT(turned, 0U);
  EXPECT_EQ(working().turnCount(), turned);
  EXPECT_GT(working().fans().size(), 0U);
}

TEST_F(WorkingMeshTest, StopsWhenAsked) {
  const std::vector<std::size_t> some{0, 1};
  const std::vector<EdgeRef> edges = mInput.edges();
  mStop = true;
  EXPECT_THROW((void)working().quadsAt(some), Cancelled);
  EXPECT_THROW(working().chooseSafeDiagonals(edges), Cancelled);
}

}  // namespace
}  // namespace pdc::detail
