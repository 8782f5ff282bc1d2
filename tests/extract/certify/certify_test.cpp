#include "extract/certify/certify.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "extract/certify/sound_checks.h"
#include "extract/topology/packed_signs.h"

namespace pdc {
namespace {

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
    SignSource source = randomGrids(engine, density);
    if (done / kPerVolume / 3 % 2 == 1) source.claimExactNormals();
    ContourReport report;
    const Mesh mesh = contour(source, {.sigmaNormal = sigma, .placement = GetParam()}, &report);
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
