#include "sample/vdb/grid_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "sample/block_hash.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/stencils/block_hermite.h"
#include "sample/stencils/isovalue_points.h"
#include "sample/vdb/stencil_reader.h"
#include "sample/vdb/surface_block_search.h"

namespace pdc::detail {
namespace {

template <typename GridT>
class TypedGridSampler final : public GridSampler {
 public:
  using TreeT = typename GridT::TreeType;

  TypedGridSampler(typename GridT::ConstPtr grid, const ValueReading& reading)
      : mGrid(std::move(grid)),
        mReading(reading),
        mReader(reading),
        mTable(mGrid->tree()),
        mLimits(slopeLimits(reading)),
        mStencils(mTable, mReader, mLimits) {}

  [[nodiscard]] GridBlocks surfaceBlocks(const Monitor& monitor, const GridSampler* weight) const override {
    monitor.throwIfStopped();
    const SurfaceBlockSearch<TreeT> search({mGrid->tree(), mTable, mReader, mReading, weight});
    monitor.throwIfStopped();
    return search.find(monitor);
  }

  /// From evenly spaced leaves and large tiles; surface between tiles of leaves is left out.
  [[nodiscard]] SurfaceForecast forecast(const Monitor& monitor) const override {
    constexpr std::size_t kMostLeaves = 2048;
    const std::size_t count = std::min(kMostLeaves, mTable.size());
    SurfaceForecast forecast;
    LeafValues<typename TreeT::LeafNodeType> values;
    for (std::size_t i = 0; i < count; ++i) {
      monitor.throwIfStopped();
      const std::size_t leaf = i * mTable.size() / count;
      const double crossings = crossingsWithin(insideOf(values.read(mTable.leaf(leaf), mTable.values(leaf))));
      forecast.crossings += crossings;
      forecast.blocks += crossings > 0 ? 1 : 0;
    }
    const double weight = count > 0 ? static_cast<double>(mTable.size()) / static_cast<double>(count) : 0;
    const double aboutTiles = TileFaces<TreeT>(mGrid->tree(), mReader).forecast();
    constexpr double kOfBlock = kBlockSize * kBlockSize;
    return {.blocks = weight * forecast.blocks + aboutTiles / kOfBlock,
            .crossings = weight * forecast.crossings + aboutTiles};
  }

  [[nodiscard]] CellMask positivePoints(const Coord& block) const override {
    const auto positive = [](auto v) { return v > 0 && isFiniteValue(v); };
    const typename LeafTable<TreeT>::Place place = typename LeafTable<TreeT>::Around(mTable, block)(0, 0, 0);
    if (place.leaf < 0) return positive(place.tile) ? CellMask::all() : CellMask{};
    const auto& leaf = mTable.leaf(static_cast<std::size_t>(place.leaf));
    CellMask points;
    for (openvdb::Index i = 0; i < TreeT::LeafNodeType::SIZE; ++i)
      points.word[i / 64] |= std::uint64_t{positive(leaf.getValue(i))} << i % 64;
    return points;
  }

  void prefetch(const Coord& block) const override { mStencils.prefetch(block); }

  void fillHermite(const SurfaceBlock& block, const LatticeMap& map, HermiteBlock& hermite) const override {
    GradientStencil stencil;
    mStencils.read(block.coord, block.edges, stencil);
    fillBlockHermite(stencil, block, mLimits, map, hermite);
  }

  [[nodiscard]] std::vector<Coord> someLeaves(std::size_t most) const override {
    std::vector<Coord> all(mTable.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = mTable.coord(i);
    return sampleOfBlocks(all, most);
  }

  void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const override {
    mStencils.read(block, scale, stencil);
    fillIsovaluePoints(stencil);
  }

 private:
  [[nodiscard]] CellMask insideOf(const typename TreeT::ValueType* values) const {
    typename ValueReader<typename TreeT::ValueType>::Remarks ignored;
    CellMask inside;
    for (int x = 0; x < kBlockSize; ++x)
      inside.word[x] = mReader.insideBits(values + kBlockSize * kBlockSize * x, ignored);
    return inside;
  }

  typename GridT::ConstPtr mGrid;
  ValueReading mReading;
  ValueReader<typename TreeT::ValueType> mReader;
  LeafTable<TreeT> mTable;
  SlopeLimits mLimits;
  StencilReader<TreeT> mStencils;
};

}  // namespace

std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid,
                                                   const ValueReading& reading) {
  std::unique_ptr<const GridSampler> sampler;
  visitContourable(*grid, [&]<typename GridT>(const GridT&) {
    sampler = std::make_unique<TypedGridSampler<GridT>>(openvdb::GridBase::constGrid<GridT>(grid), reading);
  });
  return sampler;
}

}  // namespace pdc::detail
