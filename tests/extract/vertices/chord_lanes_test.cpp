#include "extract/vertices/chord_lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>

#include "extract/sign_source.h"
#include "extract/topology/patch_list.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

const CellMetric kSheared(Mat3d{{Vec3d{1.3, 0.2, 0}, Vec3d{-0.1, 0.7, 0.3}, Vec3d{0, 0.4, 1.1}}}, 1);

/// A volume of random signs, in which patches have three to twelve crossings.
SignSource randomSigns() {
  std::mt19937 engine(11);
  std::bernoulli_distribution inside(0.4);
  SignSource source(20, false);
  for (int i = 0; i < 20 * 20 * 20; ++i) source.set(i / 400, i / 20 % 20, i % 20, inside(engine));
  return source;
}

/// The patches of a block and its crossings.
struct Block {
  Block(const SignSource& source, const SurfaceBlocks& blocks, const Topology& topology, std::size_t i)
      : edges(blocks.signs[i]) {
    HermiteBlock hermite;
    source.fillHermite({blocks.coords[i], blocks.signs[i], edges}, hermite);
    const Vec3d origin = blockOrigin(blocks.coords[i]);
    crossings.fill(hermite, edges, kSheared, source.map(), origin, SimdLevel::kBaseline);
    patches.fill(topology.blocks[i], blocks.signs[i]);
  }

  EdgeIndex edges;
  CrossingPlanes crossings;
  PatchList patches;
};

double residualOf(const Block& block, const SurfacePatch& patch) {
  PatchSamples samples;
  forEachEdge(patch, block.edges, [&](int e, int number) {
    const int k = samples.size++;
    samples.position[k] = cornerPlace(kCellEdge[e].low);
    samples.position[k][kCellEdge[e].axis] += double{block.crossings.t(number)};
    samples.row[k] = vecCast<double>(block.crossings.plane(number));
  });
  return chordResidual(samples, kSheared);
}

/// Every other patch from `first` on, in as many lanes.
std::array<float, kLanes> residualsOf(const Block& block, std::size_t first, SimdLevel level, ChordLanes& chords) {
  std::array<float, kLanes> residuals{};
  const SymMat3<double>& G = kSheared.G;
  const SymMat3<float> metric{float(G.xx), float(G.xy), float(G.xz), float(G.yy), float(G.yz), float(G.zz)};
  withSimd(level, [&] {
    chords.clear();
    for (int lane = 0; lane < kLanes && first + lane < block.patches.size(); lane += 2)
      chords.load(lane, block.patches[first + lane], block.edges, block.crossings);
    chords.residuals(metric, residuals.data());
  });
  return residuals;
}

TEST(ChordLanes, AreTheResidualsOfThePatchesLoaded) {
  const SignSource source = randomSigns();
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const Topology topology = buildTopology(blocks, {});
  ChordLanes chords;
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    const auto block = std::make_unique<Block>(source, blocks, topology, i);
    for (std::size_t first = 0; first < block->patches.size(); first += kLanes) {
      const std::array<float, kLanes> residuals = residualsOf(*block, first, SimdLevel::kBaseline, chords);
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool loaded = lane % 2 == 0 && first + lane < block->patches.size();
        const double expected = loaded ? residualOf(*block, block->patches[first + lane]) : 0;
        ASSERT_NEAR(residuals[lane], expected, 1e-4 * expected) << "lane " << lane;
      }
      for (const SimdLevel level : test::wideSimdLevels())
        ASSERT_EQ(residualsOf(*block, first, level, chords), residuals);
    }
  }
}

}  // namespace
}  // namespace pdc::detail
