#include "extract/vertices/patch_sums.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "extract/sign_source.h"
#include "math/lane_loops.h"
#include "simd_levels.h"

namespace pdc::detail {
namespace {

constexpr SymMat3<float> kMetric{1.5F, 0.25F, -0.5F, 1.25F, 0.125F, 0.75F};

/// A volume of random signs, some of whose cells have several patches.
SignSource randomSigns(bool open) {
  std::mt19937 engine(11);
  std::bernoulli_distribution inside(0.4);
  SignSource source(20, open);
  for (int i = 0; i < 20 * 20 * 20; ++i) source.set(i / 400, i / 20 % 20, i % 20, inside(engine));
  return source;
}

/// What is summed up of one block.
struct Block {
  Block(const SignSource& source, const SurfaceBlocks& blocks, const Topology& topology, std::size_t i)
      : edges(blocks.signs[i]) {
    source.fillHermite({blocks.coords[i], blocks.signs[i], edges}, hermite);
    const Vec3d origin = blockOrigin(blocks.coords[i]);
    crossings.fill(hermite, edges, blockMetric(source.map(), origin), source.map(), origin, SimdLevel::kBaseline);
    std::mt19937 engine(static_cast<unsigned>(i));
    std::uniform_real_distribution<float> value(0, 1);
    for (int k = 0; k < edges.size(); ++k) {
      noise.sigma[k] = value(engine);
      noise.weight[k] = value(engine);
    }
    crossings.setNoise(noise, edges, kVariance);
    patches.fill(topology.blocks[i], blocks.signs[i]);
  }

  static constexpr double kVariance = 0.25;
  EdgeIndex edges;
  HermiteBlock hermite;
  PlaneNoise noise;
  CrossingPlanes crossings;
  PatchList patches;
};

template <bool kNoisy>
void add(const Block& block, PatchSums& sums, SimdLevel level) {
  withSimd(level, [&] { sums.add<kNoisy>(block.patches, block.crossings, block.edges, kMetric); });
}

/// Straight from what PatchSums promises.
template <bool kNoisy>
void expectSums(const Block& block, const PatchSums& sums) {
  for (std::size_t i = 0; i < block.patches.size(); ++i) {
    SymMat3<double> A{};
    Vec3d b{}, place{};
    double weight = 0;
    forEachEdge(block.patches[i], block.edges, [&](int e, int number) {
      Vec3d p = cornerPlace(kCellEdge[e].low);
      p[kCellEdge[e].axis] += double{block.crossings.t(number)};
      SymMat3<double> own = outer(vecCast<double>(block.crossings.plane(number)));
      double w = 1;
      if constexpr (kNoisy) {
        w = double{std::max(block.noise.weight[number], CrossingPlanes::kLeastWeight)};
        const double sigma = double{block.noise.sigma[number]}, variance = Block::kVariance + sigma * sigma;
        const SymMat3<double> G{kMetric.xx, kMetric.xy, kMetric.xz, kMetric.yy, kMetric.yz, kMetric.zz};
        own = (own + G * variance) * w;
      }
      A += own;
      b += own * p;
      place += p * w;
      weight += w;
    });
    const PatchSumLanes& lanes = sums.lanes(i / kLanes * kLanes);
    const int lane = static_cast<int>(i % kLanes);
    const SymMat3<float> found = lanes.A(lane);
    constexpr double kRounding = 1e-5;
    for (const auto& [f, expected] : {std::pair{found.xx, A.xx},
                                      {found.xy, A.xy},
                                      {found.xz, A.xz},
                                      {found.yy, A.yy},
                                      {found.yz, A.yz},
                                      {found.zz, A.zz},
                                      {lanes.weight(lane), weight}})
      ASSERT_NEAR(f, expected, kRounding) << "patch " << i;
    ASSERT_LT(length(vecCast<double>(lanes.b(lane)) - b), kRounding) << "patch " << i;
    ASSERT_LT(length(vecCast<double>(lanes.place(lane)) - place), kRounding) << "patch " << i;
  }
}

template <bool kNoisy>
void expectTheSameWithEveryInstructionSet(const Block& block) {
  PatchSums plain;
  add<kNoisy>(block, plain, SimdLevel::kBaseline);
  expectSums<kNoisy>(block, plain);
  for (const SimdLevel level : test::wideSimdLevels()) {
    PatchSums sums;
    add<kNoisy>(block, sums, level);
    for (std::size_t first = 0; first < block.patches.size(); first += kLanes)
      ASSERT_EQ(std::memcmp(&sums.lanes(first), &plain.lanes(first), sizeof(PatchSumLanes)), 0);
  }
}

TEST(PatchSums, AreThoseOfEachPatchsOwnCrossings) {
  for (const bool open : {false, true}) {
    const SignSource source = randomSigns(open);
    const SurfaceBlocks blocks = source.surfaceBlocks({});
    const Topology topology = buildTopology(blocks, {});
    std::size_t multiVertex = 0;
    for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
      const auto block = std::make_unique<Block>(source, blocks, topology, i);
      multiVertex += block->patches.multiVertex().size();
      expectTheSameWithEveryInstructionSet<false>(*block);
      expectTheSameWithEveryInstructionSet<true>(*block);
    }
    EXPECT_GT(multiVertex, 100u);
  }
}

// One after the other through the same sums: nothing of a block may be left for the next, where in open volumes cells
// that take no part have crossings about them too.
TEST(PatchSums, OfOneBlockLeaveNothingToTheNext) {
  const SignSource source = randomSigns(true);
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const Topology topology = buildTopology(blocks, {});
  PatchSums sums;
  for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
    const auto block = std::make_unique<Block>(source, blocks, topology, i);
    add<false>(*block, sums, bestSimdLevel());
    expectSums<false>(*block, sums);
  }
}

}  // namespace
}  // namespace pdc::detail
