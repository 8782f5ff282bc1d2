#include "sample/vdb/grid_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "sample/block_hash.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/vdb/gradient_stencil.h"
#include "sample/vdb/isovalue_points.h"
#include "sample/vdb/stencil_reader.h"
#include "sample/vdb/surface_block_search.h"

namespace pdc::detail {
namespace {

/// Which values may enter slopes. Finite even where nothing is clamped, so that infinite values are left out.
SlopeLimits slopeLimits(const GridReading& reading) {
  constexpr double kMostClamp = 1e38;  // A slope of larger values may not fit into single precision.
  const double clamp = std::min(reading.clamp, kMostClamp);
  const double iso = reading.insideIsHigher ? -reading.iso : reading.iso;
  const double low = -clamp - iso, high = clamp - iso;
  return {static_cast<float>(low + 1e-6 * std::abs(low)), static_cast<float>(high - 1e-6 * std::abs(high))};
}

/// Turns the gradients of a map that is not affine, which are in `hermite` in lattice units, into normals.
template <typename NormalMap>
void mapNormals(const Coord& block, const EdgeIndex& edges, const NormalMap& normalMap, HermiteBlock& hermite) {
  edges.forEach([&](int i, int axis, int x, int y, int z) {
    Vec3d at{8.0 * block[0] + x, 8.0 * block[1] + y, 8.0 * block[2] + z};
    at[axis] += hermite.t[i];
    const Vec3d g = normalMap(at) * Vec3d{hermite.nx[i], hermite.ny[i], hermite.nz[i]};
    const double l = length(g);
    const Vec3f n = vecCast<float>(l > 0 && std::isfinite(l) ? g * (1 / l) : Vec3d{});
    hermite.nx[i] = n.x;
    hermite.ny[i] = n.y;
    hermite.nz[i] = n.z;
  });
}

template <typename GridT>
class TypedGridSampler final : public GridSampler {
 public:
  using TreeT = typename GridT::TreeType;

  TypedGridSampler(typename GridT::ConstPtr grid, const GridReading& reading)
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

  /// From evenly spaced leaves; surface between tiles is left out.
  [[nodiscard]] SurfaceForecast forecast(const Monitor& monitor) const override {
    constexpr std::size_t kMostLeaves = 2048;
    const std::size_t count = std::min(kMostLeaves, mTable.size());
    SurfaceForecast forecast;
    LeafValues<typename TreeT::LeafNodeType> values;
    for (std::size_t i = 0; i < count; ++i) {
      monitor.throwIfStopped();
      const std::size_t leaf = i * mTable.size() / count;
      const double crossings = crossingsWithin(values.read(mTable.leaf(leaf), mTable.values(leaf)));
      forecast.crossings += crossings;
      forecast.blocks += crossings > 0 ? 1 : 0;
    }
    const double weight = count > 0 ? static_cast<double>(mTable.size()) / static_cast<double>(count) : 0;
    return {.blocks = weight * forecast.blocks, .crossings = weight * forecast.crossings};
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
    const auto normalMap = [&map](const Vec3d& x) {
      // Scaled to lattice units, in which gradients are as large as differences of values.
      return inverse(map.jacobian(x)).transposed() * map.voxelSize();
    };
    if (map.affine()) {
      fillFromStencil(stencil, block.edges, mLimits, matCast<float>(normalMap({})), hermite);
    } else {
      fillFromStencil(stencil, block.edges, mLimits, Mat3f::identity(), hermite);
      mapNormals(block.coord, block.edges, normalMap, hermite);
    }
    placeIsovalueCrossings(stencil, block.signs, block.edges, hermite);
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
  /// How many edges of a block change sign, from those between a leaf's own points, which are seven of eight.
  [[nodiscard]] double crossingsWithin(const typename TreeT::ValueType* values) const {
    constexpr double kShare = double(kBlockSize - 1) / kBlockSize;
    constexpr std::uint64_t kLastZ = 0x8080808080808080, kLastY = std::uint64_t{0xFF} << 56;
    typename ValueReader<typename TreeT::ValueType>::Remarks ignored;
    std::uint64_t before = 0;
    int changes = 0;
    for (int x = 0; x < kBlockSize; ++x) {
      const std::uint64_t w = mReader.insideBits(values + kBlockSize * kBlockSize * x, ignored);
      changes += std::popcount((w ^ w >> 1) & ~kLastZ) + std::popcount((w ^ w >> 8) & ~kLastY);
      if (x > 0) changes += std::popcount(w ^ before);
      before = w;
    }
    return changes / kShare;
  }

  typename GridT::ConstPtr mGrid;
  GridReading mReading;
  ValueReader<typename TreeT::ValueType> mReader;
  LeafTable<TreeT> mTable;
  SlopeLimits mLimits;
  StencilReader<TreeT> mStencils;
};

}  // namespace

std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid,
                                                   const GridReading& reading) {
  std::unique_ptr<const GridSampler> sampler;
  visitContourable(*grid, [&]<typename GridT>(const GridT&) {
    sampler = std::make_unique<TypedGridSampler<GridT>>(openvdb::GridBase::constGrid<GridT>(grid), reading);
  });
  return sampler;
}

}  // namespace pdc::detail
