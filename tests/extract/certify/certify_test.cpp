#include "extract/certify/certify.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <ostream>
#include <string>
#include <vector>

#include "extract/certify/sound_checks.h"
#include "extract/certify/uncertified_mesh.h"
#include "extract/topology/packed_signs.h"

namespace pdc {
namespace {

struct PromisedPlacement {
  Placement placement;
  const char* name;
  friend void PrintTo(const PromisedPlacement& p, std::ostream* out) { *out << p.name; }
};

class CertifyTest : public testing::TestWithParam<PromisedPlacement> {};

// Random signs with random crossings and normals: vertices lie anywhere their placement lets them.
TEST_P(CertifyTest, RandomGridsAreSound) {
  const int usual = GetParam().placement == Placement::kCell ? 100'000 : 10'000;
  const int grids = std::getenv("PDC_LONG_TESTS") != nullptr ? 10 * usual : usual;
  constexpr int kPerVolume = kPerAxis * kPerAxis * kPerAxis;
  std::mt19937 engine(4);
  for (int done = 0; done < grids; done += kPerVolume) {
    const double density = std::array{0.3, 0.5, 0.7}[done / kPerVolume % 3];
    const double sigma = std::array{0.02, 0.1, 1.0, 0.0}[done / kPerVolume % 4];
    SignSource source = randomGrids(engine, density);
    if (done / kPerVolume / 3 % 2 == 1) source.claimExactNormals();
    ContourReport report;
    const Mesh mesh = contour(source, {.sigmaNormal = sigma, .placement = GetParam().placement}, &report);
    expectSound(mesh, report);
    EXPECT_GT(report.multiVertexCells, 0u);
    if (HasFailure()) FAIL() << "grids from " << done << ", sigma " << sigma;
  }
}

INSTANTIATE_TEST_SUITE_P(Placements, CertifyTest,
                         testing::Values(PromisedPlacement{Placement::kCertified, "Certified"},
                                         PromisedPlacement{Placement::kCell, "Cell"}),
                         [](const auto& test) { return test.param.name; });

TEST(Certify, TheTestBitesOnFreeVertices) {
  std::mt19937 engine(4);
  const Mesh mesh = contour(randomGrids(engine, 0.5), {.placement = Placement::kFree});
  EXPECT_FALSE(selfIntersections(mesh).pairs.empty());
}

TEST(Certify, ReportsProgressThatNeverGoesBackAndEndsAtOne) {
  std::mt19937 engine(5);
  std::vector<double> shares;
  std::mutex mutex;
  const Monitor monitor{.progress = [&](const char* stage, double share) {
    const std::lock_guard lock(mutex);
    if (std::string(stage) == "certify") shares.push_back(share);
  }};
  (void)contour(detail::randomGrid(engine, 16, false), {}, nullptr, monitor);
  ASSERT_GT(shares.size(), 5U);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LE(shares[i - 1], shares[i]);
}

// Whatever it is doing at the time: the stop comes at each of its reports in turn.
TEST(Certify, StopsWhenAsked) {
  std::mt19937 engine(5);
  const SignSource source = detail::randomGrid(engine, 16, false);
  std::atomic<int> all{0};
  (void)contour(source, {}, nullptr,
                {.progress = [&](const char* stage, double) { all += std::string(stage) == "certify"; }});
  ASSERT_GT(all, 5);
  // The last report says that it is done.
  for (int at = 0; at + 1 < all; ++at) {
    std::atomic<bool> stop{false};
    std::atomic<int> reports{0};
    const Monitor monitor{.progress =
                              [&](const char* stage, double) {
                                if (std::string(stage) == "certify" && reports++ == at) stop = true;
                              },
                          .stop = &stop};
    EXPECT_THROW((void)contour(source, {}, nullptr, monitor), Cancelled) << "at report " << at;
  }
}

}  // namespace
}  // namespace pdc
