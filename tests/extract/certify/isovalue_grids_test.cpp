// Grids with many values exactly on the isovalue: the promises hold, whatever points on it are inside.

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cstdlib>
#include <random>
#include <string>

#include "extract/certify/sound_checks.h"
#include "extract/topology/packed_signs.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

/// Values -1, 0 and 1: calls fill(accessor, index, low corner) for each of kPerAxis³ places.
template <typename Fill>
openvdb::FloatGrid::Ptr packValues(Fill&& fill) {
  auto grid = openvdb::FloatGrid::create(1);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  for (int i = 0; i < kPerAxis * kPerAxis * kPerAxis; ++i)
    fill(accessor, i,
         openvdb::Coord(kPitch * (i / (kPerAxis * kPerAxis)) + 1, kPitch * (i / kPerAxis % kPerAxis) + 1,
                        kPitch * (i % kPerAxis) + 1));
  return grid;
}

void expectSoundGrid(const openvdb::FloatGrid::Ptr& grid, Placement placement) {
  ContourReport report;
  const Mesh mesh = contour(GridSource(grid, {}), {.placement = placement}, &report);
  expectSound(mesh, report);
}

/// A box of points, each with any of the three values.
struct Neighbourhood {
  const char* name;
  openvdb::Coord size;
  int step;  ///< One in so many patterns is tried, all of them in long runs.

  [[nodiscard]] int points() const { return size.x() * size.y() * size.z(); }
};

class IsovalueGrids : public testing::TestWithParam<Neighbourhood> {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

std::uint64_t power3(int n) { return n == 0 ? 1 : 3 * power3(n - 1); }

TEST_P(IsovalueGrids, AllNeighbourhoodsAreSound) {
  const Neighbourhood& n = GetParam();
  const auto step = static_cast<std::uint64_t>(std::getenv("PDC_LONG_TESTS") != nullptr ? 1 : n.step);
  const std::uint64_t patterns = power3(n.points());
  std::uint64_t next = 0;
  while (next < patterns) {
    const std::uint64_t first = next;
    const auto grid = packValues([&](auto& accessor, int, const openvdb::Coord& low) {
      if (next >= patterns) return;
      std::uint64_t digits = next;
      next += step;
      for (int k = 0; k < n.points(); ++k, digits /= 3) {
        const int yz = n.size.y() * n.size.z();
        accessor.setValue(low.offsetBy(k / yz, k / n.size.z() % n.size.y(), k % n.size.z()),
                          static_cast<float>(digits % 3) - 1);
      }
    });
    for (const Placement placement : {Placement::kCell, Placement::kCertified}) expectSoundGrid(grid, placement);
    if (HasFailure()) FAIL() << "patterns from " << first;
  }
}

// The steps are primes, so that every value comes at every point.
INSTANTIATE_TEST_SUITE_P(Sizes, IsovalueGrids,
                         testing::Values(Neighbourhood{"Cell", {2, 2, 2}, 1}, Neighbourhood{"Face", {3, 2, 2}, 61}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Fills boxes of points at random, with more or fewer zeros.
class RandomIsovalueGrids : public IsovalueGrids {};

TEST_P(RandomIsovalueGrids, AreSound) {
  const Neighbourhood& n = GetParam();
  const int usual = n.step, grids = std::getenv("PDC_LONG_TESTS") != nullptr ? 100 * usual : usual;
  std::mt19937 engine(7);
  for (int done = 0; done < grids; done += kPerAxis * kPerAxis * kPerAxis) {
    const double zeros = std::array{0.2, 0.5, 0.8}[done / (kPerAxis * kPerAxis * kPerAxis) % 3];
    std::discrete_distribution<int> value({0.55 * (1 - zeros), zeros, 0.45 * (1 - zeros)});
    const auto grid = packValues([&](auto& accessor, int, const openvdb::Coord& low) {
      for (int x = 0; x < n.size.x(); ++x)
        for (int y = 0; y < n.size.y(); ++y)
          for (int z = 0; z < n.size.z(); ++z)
            accessor.setValue(low.offsetBy(x, y, z), static_cast<float>(value(engine) - 1));
    });
    for (const Placement placement : {Placement::kCell, Placement::kCertified}) expectSoundGrid(grid, placement);
    if (HasFailure()) FAIL() << "grids from " << done;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomIsovalueGrids,
                         testing::Values(Neighbourhood{"Edge", {3, 3, 2}, 10'000},
                                         Neighbourhood{"Grid", {6, 6, 6}, 1'000}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pdc
