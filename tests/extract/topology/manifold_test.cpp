#include <gtest/gtest.h>

#include <random>

#include "extract/faces/fill_mesh.h"
#include "extract/topology/block_topology.h"
#include "extract/topology/packed_signs.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

void expectSound(const MeshReport& r) {
  EXPECT_EQ(r.nonManifoldEdges, 0u);
  EXPECT_EQ(r.nonManifoldVertices, 0u);
  EXPECT_EQ(r.misorientedEdges, 0u);
  EXPECT_EQ(r.degenerateFaces, 0u);
  EXPECT_EQ(r.duplicateFaces, 0u);
  EXPECT_EQ(r.unusedVertices, 0u);
}

void expectClosed(const MeshReport& r) {
  expectSound(r);
  EXPECT_EQ(r.boundaryEdges, 0u);
  EXPECT_EQ(r.eulerNumber % 2, 0);
  EXPECT_GT(r.volume, 0);
}

/// What contour() does, without the rule that flips pairs of cells.
Mesh contourWithoutRule(const SignSource& source) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const detail::Topology topology = detail::buildTopology(blocks, {}, detail::FlipRule::kNever);
  Mesh mesh;
  detail::fillMesh({source, blocks, topology}, {.sigma = 0.1, .halfSize = detail::kFreeHalfSize}, mesh, nullptr, {});
  return mesh;
}

// Every sign pattern of the 3×3×2 points about a lattice edge, as a closed solid of its own. Random grids are in
// certify_test.cpp.
TEST(Manifold, AllNeighbourhoodsOfAnEdge) {
  constexpr unsigned kPatterns = 1u << 18;
  constexpr unsigned kPerVolume = kPerAxis * kPerAxis * kPerAxis;
  for (unsigned first = 0; first < kPatterns; first += kPerVolume) {
    const SignSource source = pack(false, [&](SignSource& s, int i, int x, int y, int z) {
      const unsigned bits = first + static_cast<unsigned>(i);
      for (int k = 0; k < 18 && bits < kPatterns; ++k) s.set(x + k % 3, y + k / 3 % 3, z + k / 9, (bits >> k & 1) != 0);
    });
    expectClosed(analyze(contour(source, {.sigmaNormal = 0.1})));
    if (HasFailure()) FAIL() << "patterns from " << first;
  }
}

TEST(Manifold, TheTestBitesWithoutTheRule) {
  std::mt19937 engine(1);
  EXPECT_GT(analyze(contourWithoutRule(randomGrids(engine, 0.5))).nonManifoldEdges, 0u);
}

// Open surfaces: only what lies wholly in the volume is meshed, so the random grids fill it to its border.
TEST(Manifold, OpenBordersAreManifoldToo) {
  std::mt19937 engine(2);
  for (const double density : {0.3, 0.5, 0.7}) {
    constexpr int kSize = 40;
    SignSource source(kSize, true);
    std::bernoulli_distribution inside(density);
    for (int i = 0; i < kSize * kSize * kSize; ++i)
      source.set(i / (kSize * kSize), i / kSize % kSize, i % kSize, inside(engine));
    ContourReport report;
    const MeshReport mesh = analyze(contour(source, {.sigmaNormal = 0.1}, &report));
    expectSound(mesh);
    EXPECT_GT(mesh.boundaryEdges, 0u);
    EXPECT_EQ(mesh.boundaryEdges, report.boundaryEdges);
  }
}

TEST(Manifold, TrianglesAreTheQuadsSplit) {
  std::mt19937 engine(3);
  const SignSource source = randomGrids(engine, 0.5);
  const Mesh quads = contour(source), triangles = contour(source, {.triangles = true});
  const std::size_t split = 2 * quads.quads.size();
  ASSERT_FALSE(quads.triangles.empty()) << "no fans";
  ASSERT_EQ(triangles.triangles.size(), split + quads.triangles.size());
  EXPECT_TRUE(std::equal(quads.triangles.begin(), quads.triangles.end(), triangles.triangles.begin() + split));
  expectClosed(analyze(triangles));
  for (std::size_t i = 0; i < quads.quads.size(); ++i) {
    const Quad& q = quads.quads[i];
    ASSERT_EQ(triangles.triangles[2 * i], (Triangle{q[0], q[1], q[2]}));
    ASSERT_EQ(triangles.triangles[2 * i + 1], (Triangle{q[0], q[2], q[3]}));
  }
}

}  // namespace
}  // namespace pdc
