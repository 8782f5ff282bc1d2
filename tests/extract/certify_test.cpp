#include "extract/certify.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "extract/packed_signs.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"

namespace pdc {
namespace {

void expectSound(const Mesh& mesh, const ContourReport& report) {
  EXPECT_EQ(report.uncertified, 0u);
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(facts.boundaryEdges, 0u);
  EXPECT_EQ(facts.nonManifoldEdges, 0u);
  EXPECT_EQ(facts.nonManifoldVertices, 0u);
  EXPECT_EQ(facts.misorientedEdges, 0u);
  EXPECT_EQ(facts.duplicateFaces, 0u);
  EXPECT_EQ(facts.unusedVertices, 0u);
  EXPECT_EQ(facts.eulerNumber % 2, 0);
  EXPECT_GT(facts.volume, 0);
  const SelfIntersections found = selfIntersections(mesh);
  EXPECT_EQ(found.pairs.size(), 0u);
  EXPECT_EQ(found.degenerateTriangles, 0u);
}

class CertifyTest : public testing::TestWithParam<Placement> {};

// Random signs with random crossings and normals: vertices lie anywhere their placement lets them.
TEST_P(CertifyTest, RandomGridsAreSound) {
  const int usual = GetParam() == Placement::kCell ? 100'000 : 10'000;
  const int grids = std::getenv("PDC_LONG_TESTS") != nullptr ? 10 * usual : usual;
  constexpr int kPerVolume = kPerAxis * kPerAxis * kPerAxis;
  std::mt19937 engine(4);
  for (int done = 0; done < grids; done += kPerVolume) {
    const double density = std::array{0.3, 0.5, 0.7}[done / kPerVolume % 3];
    const double sigma = std::array{0.02, 0.1, 1.0, 0.0}[done / kPerVolume % 4];
    ContourReport report;
    const Mesh mesh = contour(randomGrids(engine, density), {.sigmaNormal = sigma, .placement = GetParam()}, &report);
    expectSound(mesh, report);
    EXPECT_GT(report.multiVertexCells, 0u);
    if (HasFailure()) FAIL() << "grids from " << done << ", sigma " << sigma;
  }
}

INSTANTIATE_TEST_SUITE_P(Placements, CertifyTest, testing::Values(Placement::kCertified, Placement::kCell),
                         [](const auto& test) { return test.param == Placement::kCell ? "Cell" : "Certified"; });

TEST(Certify, TheTestBitesOnFreeVertices) {
  std::mt19937 engine(4);
  const Mesh mesh = contour(randomGrids(engine, 0.5), {.placement = Placement::kFree});
  EXPECT_FALSE(selfIntersections(mesh).pairs.empty());
}

}  // namespace
}  // namespace pdc
