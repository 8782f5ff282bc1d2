#include "extract/conflicts/fans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

#include "extract/certify/uncertified_mesh.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc::detail {
namespace {

/// The directed edges on the rim of a fan about its centre, and of a quad.
using Rim = std::set<std::pair<std::uint32_t, std::uint32_t>>;
Rim rimOf(const Quad& q) { return {{q[0], q[1]}, {q[1], q[2]}, {q[2], q[3]}, {q[3], q[0]}}; }
Rim rimOf(const std::vector<Triangle>& fan) {
  Rim rim;
  for (const Triangle& t : fan) rim.emplace(t[1], t[2]);
  return rim;
}

class FansTest : public testing::Test {
 protected:
  [[nodiscard]] Fans& fans() { return mInput.working.fans(); }
  [[nodiscard]] std::vector<Triangle> triangles(const EdgeRef& e) {
    std::vector<Triangle> out;
    fans().triangles(e, out);
    return out;
  }

  const SignSource mSource = singlePoint();
  UncertifiedMesh mInput{mSource, 0.05, kUnstopped, true};
};

TEST_F(FansTest, AFanIsFourTrianglesAboutItsCrossingWoundLikeItsQuad) {
  std::size_t made = 0;
  for (const EdgeRef& e : mInput.edges()) {
    const std::uint64_t face = mInput.working.edgeCells().face(e);
    EXPECT_FALSE(fans().has(face));
    fans().add(e);
    fans().add(e);  // Changes nothing.
    EXPECT_TRUE(fans().has(face));
    ASSERT_EQ(fans().size(), ++made);
    ASSERT_EQ(mInput.mesh.positions.size(), 8 + made);
    const auto center = static_cast<std::uint32_t>(7 + made);
    const std::vector<Triangle> fan = triangles(e);
    ASSERT_EQ(fan.size(), 4U);
    for (const Triangle& t : fan) EXPECT_EQ(t[0], center);
    EXPECT_EQ(rimOf(fan), rimOf(mInput.mesh.quads[face]));

    const Vec3d fromEnd = vecCast<double>(mInput.mesh.positions[center]) - mInput.working.edgeCells().lowEnd(e);
    EXPECT_GE(fromEnd[e.axis()], 0.0099);
    EXPECT_LE(fromEnd[e.axis()], 0.9901);
    EXPECT_EQ(fromEnd[(e.axis() + 1) % 3], 0);
    EXPECT_EQ(fromEnd[(e.axis() + 2) % 3], 0);
    ASSERT_EQ(mInput.mesh.normals.size(), mInput.mesh.positions.size());
    EXPECT_NEAR(length(mInput.mesh.normals[center]), 1, 1e-6);
  }
}

TEST_F(FansTest, ReplaceQuadsKeepsTheOthersAndClosesTheMesh) {
  const std::vector<EdgeRef> edges = mInput.edges();
  std::multiset<Quad> others(mInput.mesh.quads.begin(), mInput.mesh.quads.end());
  for (const int i : {0, 3}) {
    others.erase(mInput.mesh.quads[mInput.working.edgeCells().face(edges[i])]);
    fans().add(edges[i]);
  }
  EXPECT_EQ(fans().replaceQuads({}), 0U);
  EXPECT_EQ(std::multiset<Quad>(mInput.mesh.quads.begin(), mInput.mesh.quads.end()), others);
  EXPECT_EQ(mInput.mesh.triangles.size(), 8U);
  const MeshReport facts = analyze(mInput.mesh);
  EXPECT_EQ(facts.boundaryEdges, 0U);
  EXPECT_EQ(facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
}

TEST_F(FansTest, TheMeshDoesNotDependOnTheOrderInWhichFansAreMade) {
  std::mt19937 random(51);
  const SignSource source = randomGrid(random, 6, false);
  std::vector<Mesh> meshes;
  for (const bool backwards : {false, true}) {
    UncertifiedMesh input(source, 0.02, kUnstopped, true);
    std::vector<EdgeRef> edges = input.edges();
    std::vector<Quad> kept;
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (i % 4 != 0) kept.push_back(input.mesh.quads[input.working.edgeCells().face(edges[i])]);
    if (backwards) std::reverse(edges.begin(), edges.end());
    const std::size_t last = (edges.size() - 1) % 4;
    for (std::size_t i = backwards ? last : 0; i < edges.size(); i += 4) input.working.fans().add(edges[i]);
    (void)input.working.fans().replaceQuads({});
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), input.mesh.quads.begin(), input.mesh.quads.end()))
        << "the quads left are not in order";
    meshes.push_back(input.mesh);
  }
  EXPECT_EQ(meshes[0].positions, meshes[1].positions);
  EXPECT_EQ(meshes[0].normals, meshes[1].normals);
  EXPECT_EQ(meshes[0].quads, meshes[1].quads);
  EXPECT_EQ(meshes[0].triangles, meshes[1].triangles);
}

TEST_F(FansTest, ASplitCellIsJoinedToOthersThroughItsFaces) {
  std::vector<EdgeRef> changed;
  ASSERT_TRUE(fans().split({0, 2, 2, 2}, changed));
  EXPECT_EQ(changed.size(), 3U);
  EXPECT_EQ(fans().size(), 3U);
  EXPECT_FALSE(fans().split({0, 2, 2, 2}, changed)) << "it has been split";
  ASSERT_EQ(mInput.mesh.positions.size(), 8U + 3 + 3) << "three centres and three vertices in faces of the cell";
  std::set<std::uint32_t> inFaces;
  for (const EdgeRef& e : changed) {
    const std::vector<Triangle> fan = triangles(e);
    EXPECT_EQ(fan.size(), 6U) << "two of the rim's four edges pass a face of the cell";
    const Quad ring = mInput.working.edgeCells().vertices(e);
    for (const Triangle& t : fan)
      if (std::find(ring.begin(), ring.end(), t[1]) == ring.end()) inFaces.insert(t[1]);
  }
  ASSERT_EQ(inFaces.size(), 3U);
  for (const std::uint32_t v : inFaces) {
    // In one of the cell's faces at (2, 2, 2), between two of the edges that end there.
    const Vec3f p = mInput.mesh.positions[v] - Vec3f{2, 2, 2};
    EXPECT_EQ((p.x == 0) + (p.y == 0) + (p.z == 0), 1);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(p[i] >= 0 && p[i] < 0.5F) << "half way between crossings";
  }
  EXPECT_EQ(fans().replaceQuads({}), 0U);
  const MeshReport facts = analyze(mInput.mesh);
  EXPECT_EQ(facts.boundaryEdges, 0U);
  EXPECT_EQ(facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
}

TEST_F(FansTest, WithAllCellsSplitEachFanHasEightTriangles) {
  std::vector<EdgeRef> changed;
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(fans().split({0, 1 + (i >> 2), 1 + (i >> 1 & 1), 1 + (i & 1)}, changed));
  EXPECT_EQ(fans().size(), 6U);
  EXPECT_EQ(fans().replaceQuads({}), 0U);
  EXPECT_TRUE(mInput.mesh.quads.empty());
  EXPECT_EQ(mInput.mesh.triangles.size(), 6U * 8);
  const MeshReport facts = analyze(mInput.mesh);
  EXPECT_EQ(facts.boundaryEdges, 0U);
  EXPECT_EQ(facts.nonManifoldEdges, 0U);
  EXPECT_EQ(facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
}

TEST_F(FansTest, ReplacingStopsWhenAsked) {
  fans().add(mInput.edges()[0]);
  const std::atomic<bool> stop{true};
  EXPECT_THROW((void)fans().replaceQuads({.progress = {}, .stop = &stop}), Cancelled);
}

TEST(Fans, RefuseVerticesThatIndicesCannotName) {
  EXPECT_EQ(Fans::numberAfter(0), 0U);
  EXPECT_EQ(Fans::numberAfter(0xFFFFFFFF), 0xFFFFFFFF);
  EXPECT_THROW((void)Fans::numberAfter(std::uint64_t{1} << 32), Error);
}

}  // namespace
}  // namespace pdc::detail
