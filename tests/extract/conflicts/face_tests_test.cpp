#include "extract/conflicts/face_tests.h"

#include <gtest/gtest.h>

#include "extract/certify/uncertified_mesh.h"

namespace pdc::detail {
namespace {

/// A cube about (2, 2, 2) with corners at half-integer places, which the tests then move.
class FaceTestsTest : public testing::Test {
 protected:
  FaceTestsTest() {
    for (const EdgeRef& e : mInput.edges())
      for (const CellRef& c : mInput.working.edgeCells().cells(e)) {
        const std::uint64_t v = mInput.topology.blocks[0].vertexAt(c.x, c.y, c.z, 0);
        mInput.mesh.positions[v] = vecCast<float>(Vec3d{c.x + 0.5, c.y + 0.5, c.z + 0.5});
      }
  }

  [[nodiscard]] const FaceTests& faces() const { return mInput.working.faces(); }
  [[nodiscard]] Quad quad(const EdgeRef& e) const { return mInput.mesh.quads[mInput.working.edgeCells().face(e)]; }

  const SignSource mSource = singlePoint();
  UncertifiedMesh mInput{mSource};
  const EdgeRef mUp = edgeOfOnlyBlock(0, 2, 2, 2);    ///< Its low end is inside.
  const EdgeRef mDown = edgeOfOnlyBlock(0, 1, 2, 2);  ///< Its high end is inside.
};

TEST_F(FaceTestsTest, ForwardIsFromInsideToOutside) {
  EXPECT_EQ(faces().forward(mUp), (Vec3d{1, 0, 0}));
  EXPECT_EQ(faces().forward(mDown), (Vec3d{-1, 0, 0}));
}

TEST_F(FaceTestsTest, AnEdgePassesItsQuadButNotTheReversedOne) {
  ASSERT_EQ(mInput.edges().size(), 6U);
  for (const EdgeRef& e : mInput.edges()) {
    const Quad q = quad(e);
    EXPECT_TRUE(faces().passes(e, q));
    EXPECT_TRUE(faces().passes(e, {q[1], q[2], q[3], q[0]}));
    EXPECT_FALSE(faces().passes(e, {q[3], q[2], q[1], q[0]}));
  }
}

TEST_F(FaceTestsTest, AnEdgePassesAQuadWithADentAlongOneDiagonalOnly) {
  const Quad q = quad(mUp);
  // Corner 1 goes past the middle, towards corner 3.
  const Vec3f middle{2.5F, 2, 2};
  mInput.mesh.positions[q[1]] = middle + (mInput.mesh.positions[q[3]] - middle) * 0.5F;
  EXPECT_FALSE(faces().passes(mUp, q));
  EXPECT_TRUE(faces().passes(mUp, {q[1], q[2], q[3], q[0]}));
}

TEST_F(FaceTestsTest, AnEdgeDoesNotPassAQuadBeyondItsEnd) {
  for (const std::uint32_t v : quad(mUp)) mInput.mesh.positions[v].x = 3.25F;
  EXPECT_FALSE(faces().passes(mUp, quad(mUp)));
  for (const std::uint32_t v : quad(mUp)) mInput.mesh.positions[v].x = 3;
  EXPECT_FALSE(faces().passes(mUp, quad(mUp))) << "a touch at the end counts as beyond it";
}

TEST_F(FaceTestsTest, TrianglesFaceForwardAlongTheirEdge) {
  const Triangle vertices{100, 101, 102};  // None is a suspect one.
  const TriangleCorners t{Vec3f{2.5F, 2, 2}, {2.5F, 3, 2}, {2.5F, 2, 3}};
  EXPECT_TRUE(faces().facesForward(mUp, vertices, t));
  EXPECT_FALSE(faces().facesForward(mDown, vertices, t));
  EXPECT_FALSE(faces().facesForward(mUp, vertices, {t[0], t[2], t[1]}));
  EXPECT_FALSE(faces().facesForward(mUp, vertices, {t[0], t[1], t[1]})) << "it has no area";
  EXPECT_FALSE(faces().facesForward(mUp, vertices, {t[0], t[1], {2.5F, 4, 2}})) << "its corners are on a line";
  EXPECT_FALSE(faces().facesForward(mUp, vertices, {t[0], t[1], {3, 2, 2}})) << "the edge lies in its plane";
}

TEST_F(FaceTestsTest, AtACreaseTrianglesMayFaceAlongOneOfItsPlanes) {
  std::vector<SuspectVertex> suspects{{.vertex = 7, .block = 0, .cell = 0, .place = {}, .safe = {}}};
  suspects[0].creaseNormals[0] = {0.6F, 0.8F, 0};
  suspects[0].creaseNormals[1] = {-1, 0, 0};
  const std::vector<VertexState> states(suspects.begin(), suspects.end());
  const FaceTests tests(mSource.map(), mInput.working.edgeCells(), mInput.working.fans(), SuspectIndex(suspects),
                        states, mInput.mesh);
  const TriangleCorners back{Vec3f{2.5F, 2, 2}, {2.5F, 2, 3}, {2.5F, 3, 2}};
  EXPECT_TRUE(tests.facesForward(mUp, {7, 101, 102}, back));
  EXPECT_TRUE(tests.facesForward(mUp, {101, 102, 7}, back));
  EXPECT_FALSE(tests.facesForward(mUp, {100, 101, 102}, back)) << "it has no corner on the crease";
  // At 107° and at 90° to the planes.
  const TriangleCorners aside{Vec3f{2, 2, 2}, {3, 2, 2}, {2, 2, 3}};
  EXPECT_FALSE(tests.facesForward(mUp, {7, 101, 102}, aside));
}

TEST_F(FaceTestsTest, PlacesAreFromTheCentresOfCells) {
  const SuspectVertex v{.vertex = 0, .block = 0, .cell = 64 * 1 + 8 * 2 + 3, .place = {}, .safe = {}};
  EXPECT_EQ(faces().worldPosition(v, {0.25F, -0.5F, 1}), (Vec3f{1.75F, 2, 4.5F}));
}

TEST_F(FaceTestsTest, AFaceIsTwoTrianglesOrAFan) {
  const Quad q = quad(mUp);
  const std::vector<Triangle> expected{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
  EXPECT_EQ(mInput.triangles(mUp), expected);
  const std::uint64_t face = mInput.working.edgeCells().face(mUp);
  EXPECT_EQ(faces().quad(face), &mInput.mesh.quads[face]);
  mInput.working.fans().add(mUp);
  EXPECT_EQ(faces().quad(face), nullptr);
  EXPECT_EQ(mInput.triangles(mUp).size(), 4U);
}

}  // namespace
}  // namespace pdc::detail
