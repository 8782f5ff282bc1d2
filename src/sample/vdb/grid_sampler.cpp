#include "sample/vdb/grid_sampler.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "math/lane_loops.h"
#include "sample/vdb/contourable_grids.h"
#include "sample/vdb/gradient_stencil.h"
#include "sample/vdb/leaf_signs.h"
#include "sample/vdb/tile_faces.h"

namespace pdc::detail {
namespace {

/// Larger than values that a slope can be made of, in single precision.
constexpr double kMostClamp = 1e38;

/// Sorts and removes what is there twice.
void sortUnique(std::vector<Coord>& blocks) {
  if (blocks.empty()) return;
  Coord low = blocks[0], high = blocks[0];
  for (const Coord& b : blocks)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], b[i]);
      high[i] = std::max(high[i], b[i]);
    }
  // As single numbers where they fit: several times as fast.
  constexpr int kBits = 21;
  bool packs = true;
  for (int i = 0; i < 3; ++i) packs = packs && std::int64_t{high[i]} - low[i] < std::int64_t{1} << kBits;
  if (!packs) {
    tbb::parallel_sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return;
  }
  const auto part = [&](const Coord& b, int i) { return static_cast<std::uint64_t>(b[i] - low[i]); };
  std::vector<std::uint64_t> keys(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i)
    keys[i] = part(blocks[i], 0) << 2 * kBits | part(blocks[i], 1) << kBits | part(blocks[i], 2);
  tbb::parallel_sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  blocks.resize(keys.size());
  constexpr std::uint64_t kPart = (std::uint64_t{1} << kBits) - 1;
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (int k = 0; k < 3; ++k) blocks[i][k] = low[k] + static_cast<std::int32_t>(keys[i] >> (2 - k) * kBits & kPart);
}

template <typename GridT>
class TypedGridSampler final : public GridSampler {
 public:
  using TreeT = typename GridT::TreeType;
  using ValueT = typename TreeT::ValueType;
  using LeafT = typename TreeT::LeafNodeType;
  using Table = LeafTable<TreeT>;
  using Signs = LeafSigns<TreeT>;
  using Place = typename Table::Place;

  TypedGridSampler(typename GridT::ConstPtr grid, const GridReading& reading)
      : mGrid(std::move(grid)), mReading(reading), mReader(reading), mTable(mGrid->tree()) {
    // Finite even where nothing is clamped, so that infinite values are left out.
    const double clamp = std::min(reading.clamp, kMostClamp);
    const double low = -clamp - reading.iso, high = clamp - reading.iso;
    mLow = static_cast<float>(low + 1e-6 * std::abs(low));
    mHigh = static_cast<float>(high - 1e-6 * std::abs(high));
  }

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    monitor.throwIfStopped();
    const Signs leaves(mTable, mReader, mReading.acceptNonFinite);
    monitor.throwIfStopped();
    SurfaceBlocks out;
    out.open = mReading.open;
    out.coords = mixedBlocks(leaves, monitor);
    out.signs.resize(out.coords.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.coords.size(), 64), [&](const auto& range) {
      monitor.throwIfStopped();
      for (std::size_t i = range.begin(); i != range.end(); ++i) readSigns(leaves, out.coords[i], out.signs[i]);
    });
    if (out.open) dropBlocksWithoutCells(out);
    return out;
  }

  /// What readStencil() will read of leaves that no block before has touched: the block's own leaf and those above it.
  void prefetch(const Coord& block) const override {
    const typename Table::Around around(mTable, block);
    const auto fetch = [&](const Place& place, std::size_t rows, std::size_t step) {
      if (place.leaf < 0 || mTable.values(place.leaf) == nullptr) return;
      constexpr std::size_t kLine = 64 / sizeof(ValueT);
      const ValueT* values = mTable.values(place.leaf);
      for (std::size_t i = 0; i < LeafT::SIZE; i += step)
        for (std::size_t k = i; k < i + rows; k += kLine) __builtin_prefetch(values + k);
    };
    constexpr std::size_t kRow = kBlockSize, kLayer = kBlockSize * kBlockSize;
    fetch(around(0, 0, 0), LeafT::SIZE, LeafT::SIZE);
    fetch(around(0, 0, 1), LeafT::SIZE, LeafT::SIZE);
    fetch(around(0, 1, 0), 2 * kRow, kLayer);
    fetch(around(1, 0, 0), 2 * kLayer, LeafT::SIZE);
  }

  void fillHermite(const Coord& block, const EdgeIndex& edges, const LatticeMap& map,
                   HermiteBlock& hermite) const override {
    GradientStencil stencil;
    readStencil(block, edges, stencil);
    const SlopeLimits limits{mLow, mHigh};
    const auto normalMap = [&map](const Vec3d& x) {
      // Scaled to lattice units, in which gradients are as large as differences of values.
      return inverse(map.jacobian(x)).transposed() * map.voxelSize();
    };
    if (map.affine()) {
      fillFromStencil(stencil, edges, limits, matCast<float>(normalMap({})), hermite);
      return;
    }
    fillFromStencil(stencil, edges, limits, Mat3f::identity(), hermite);
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

  [[nodiscard]] std::vector<Coord> someLeaves(std::size_t most) const override {
    std::vector<Coord> some(std::min(most, mTable.size()));
    for (std::size_t i = 0; i < some.size(); ++i) some[i] = mTable.coord(i * mTable.size() / some.size());
    return some;
  }

  void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const override {
    constexpr int kBelow = DistanceStencil::kBelow, kAbove = DistanceStencil::kAbove;
    constexpr int kReach = DistanceStencil::kReach, kEndReach = kBlockPoints + kReach;
    constexpr std::array<int, 3> kFirst{-kReach, 0, kBlockSize}, kEnd{0, kBlockSize, kEndReach};
    const typename Table::Around around(mTable, block);
    const ValueReader<ValueT> reader = mReader;  // Of its own, so that no store can change it.
    std::array<Rows, 3> rows;
    for (int px = 0; px < 3; ++px)
      for (int py = 0; py < 3; ++py) {
        for (int pz = 0; pz < 3; ++pz) rows[pz].find(mTable, around(px - 1, py - 1, pz - 1));
        for (int x = kFirst[px]; x < kEnd[px]; ++x)
          for (int y = kFirst[py]; y < kEnd[py]; ++y) {
            if ((stencil.rows[x + kReach] >> (y + kReach) & 1) == 0) continue;
            float* to = &stencil.value[DistanceStencil::index(x, y, 0)];
            reader.template copy<kBelow>(rows[0].at(x, y) + (kBlockSize - kBelow), to - kBelow);
            reader.template copy<kBlockSize>(rows[1].at(x, y), to);
            reader.template copy<kAbove>(rows[2].at(x, y), to + kBlockSize);
          }
      }
    scaleKnown(scale, stencil);
  }

 private:
  /// Every block whose 9×9×9 points are not all on one side, each once, sorted.
  [[nodiscard]] std::vector<Coord> mixedBlocks(const Signs& leaves, const Monitor& monitor) const {
    std::vector<Coord> blocks;
    TileFaces<TreeT>(mGrid->tree(), mReader).find(monitor, blocks);
    std::erase_if(blocks, [&](const Coord& b) { return !isMixed(leaves, b); });
    tbb::enumerable_thread_specific<std::vector<Coord>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mTable.size(), 256), [&](const auto& range) {
      monitor.throwIfStopped();
      std::vector<Coord>& local = found.local();
      for (std::size_t l = range.begin(); l != range.end(); ++l) {
        const Coord& b = mTable.coord(l);
        if (isMixed(leaves, b)) local.push_back(b);
        addTilesBelow(leaves, l, local);
      }
    });
    for (const std::vector<Coord>& part : found) blocks.insert(blocks.end(), part.begin(), part.end());
    sortUnique(blocks);
    return blocks;
  }

  /// A leaf's points are corners of cells of the seven blocks below it too. Adds those that are tiles, unless the
  /// leaf's points there are on the tile's side.
  void addTilesBelow(const Signs& leaves, std::size_t leaf, std::vector<Coord>& blocks) const {
    const Coord& b = mTable.coord(leaf);
    const typename Table::Around around(mTable, b);
    for (int i = 1; i < 8; ++i) {
      const int dx = i >> 2, dy = i >> 1 & 1, dz = i & 1;
      const Place tile = around(-dx, -dy, -dz);
      if (tile.leaf >= 0) continue;
      const Side side = leaves.side(tile);
      if (leaves.side(leaf) == side || cornersIn(leaves.inside(leaf), i) == side) continue;
      blocks.push_back({b[0] - dx, b[1] - dy, b[2] - dz});
    }
  }

  [[nodiscard]] bool isMixed(const Signs& leaves, const Coord& block) const {
    const typename Table::Around around(mTable, block);
    std::array<Place, 8> part;
    std::array<Side, 8> side;
    bool mixed = false;
    for (int i = 0; i < 8; ++i) {
      part[i] = around(i >> 2, i >> 1 & 1, i & 1);
      side[i] = leaves.side(part[i]);
      mixed = mixed || side[i] != side[0];
    }
    if (side[0] == Side::kBoth || !mixed) return side[0] == Side::kBoth;
    for (int i = 1; i < 8; ++i)
      if (side[i] != side[0] && (side[i] != Side::kBoth || cornersIn(leaves.inside(part[i].leaf), i) != side[0]))
        return true;
    return false;
  }

  /// Where those points of part i of a block lie (see readSigns) that are corners of the block's cells.
  static Side cornersIn(const CellMask& inside, int part) {
    const std::uint64_t rows =
        ((part & 2) != 0 ? 0xFF : ~std::uint64_t{0}) & ((part & 1) != 0 ? 0x0101010101010101 : ~std::uint64_t{0});
    std::uint64_t any = inside.word[0] & rows, all = inside.word[0] & rows;
    for (int x = 1; x < ((part & 4) != 0 ? 1 : kBlockSize); ++x) {
      any |= inside.word[x] & rows;
      all &= inside.word[x] & rows;
    }
    return any == 0 ? Side::kOutside : all == rows ? Side::kInside : Side::kBoth;
  }

  /// Gathers a block's 9×9×9 points from the eight leaves or tiles they lie in; part 4dx + 2dy + dz lies at
  /// +(dx, dy, dz).
  void readSigns(const Signs& leaves, const Coord& block, BlockSigns& signs) const {
    const typename Table::Around around(mTable, block);
    std::array<CellMask, 8> inside, active;
    for (int i = 0; i < 8; ++i) {
      const Place place = around(i >> 2, i >> 1 & 1, i & 1);
      inside[i] = leaves.mask(place);
      if (mReading.open) active[i] = activePoints(place, block, i);
    }
    joinRows(inside, signs.row);
    signs.cells = CellMask::all();
    if (!mReading.open) return;
    BlockSigns activity;
    joinRows(active, activity.row);
    signs.cells = cellsWithAllCorners(activity);
  }

  [[nodiscard]] CellMask activePoints(const Place& place, const Coord& block, int part) const {
    if (place.leaf < 0) {
      const openvdb::Coord origin((block[0] + (part >> 2)) * kBlockSize, (block[1] + (part >> 1 & 1)) * kBlockSize,
                                  (block[2] + (part & 1)) * kBlockSize);
      return mGrid->tree().isValueOn(origin) ? CellMask::all() : CellMask{};
    }
    CellMask m;
    const auto& mask = mTable.leaf(place.leaf).getValueMask();
    for (openvdb::Index w = 0; w < kBlockSize; ++w) m.word[w] = mask.template getWord<std::uint64_t>(w);
    return m;
  }

  static void dropBlocksWithoutCells(SurfaceBlocks& blocks) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blocks.coords.size(); ++i) {
      if (blocks.signs[i].cells.none()) continue;
      blocks.coords[kept] = blocks.coords[i];
      blocks.signs[kept++] = blocks.signs[i];
    }
    blocks.coords.resize(kept);
    blocks.signs.resize(kept);
  }

  static void joinRows(const std::array<CellMask, 8>& part,
                       std::array<std::uint16_t, kBlockPoints * kBlockPoints>& row) {
    using Bytes = std::array<std::uint8_t, kBlockSize>;
    for (int x = 0; x < kBlockPoints; ++x) {
      const int i = (x >> 3) << 2;
      std::uint16_t* to = &row[kBlockPoints * x];
      const auto low = std::bit_cast<Bytes>(part[i].word[x & 7]), high = std::bit_cast<Bytes>(part[i | 1].word[x & 7]);
      for (int y = 0; y < kBlockSize; ++y) to[y] = static_cast<std::uint16_t>(low[y] | (high[y] & 1) << 8);
      to[kBlockSize] =
          static_cast<std::uint16_t>((part[i | 2].word[x & 7] & 0xFF) | (part[i | 3].word[x & 7] & 1) << 8);
    }
  }

  static CellMask cellsWithAllCorners(const BlockSigns& points) {
    CellMask cells;
    for (int x = 0; x < kBlockSize; ++x)
      for (int y = 0; y < kBlockSize; ++y) {
        const auto row = [&](int dx, int dy) { return unsigned{points.row[kBlockPoints * (x + dx) + y + dy]}; };
        const unsigned all = row(0, 0) & row(0, 1) & row(1, 0) & row(1, 1);
        cells.word[x] |= std::uint64_t{all & all >> 1 & 0xFF} << 8 * y;
      }
    return cells;
  }

  /// Scales the values that a slope may be made of, and makes the others NaN.
  void scaleKnown(float scale, DistanceStencil& stencil) const {
    withSimd(bestSimdLevel(), [&stencil, scale, low = mLow, high = mHigh] {
      for (float& v : stencil.value) {
        const float scaled = v * scale;
        v = ((v > low) & (v < high)) ? scaled : std::numeric_limits<float>::quiet_NaN();
      }
    });
  }

  /// A neighbouring block's rows of eight values along z; those of a tile are all the same.
  class Rows {
   public:
    void find(const Table& table, const Place& place) {
      mStride = place.leaf < 0 ? 0 : kBlockSize;
      if (place.leaf < 0) {
        mTile.fill(place.tile);
        mValues = mTile.data();
      } else {
        mValues = mLeaf.read(table.leaf(place.leaf), table.values(place.leaf));
      }
    }
    [[nodiscard]] const ValueT* row(int i) const { return mValues + mStride * i; }
    [[nodiscard]] const ValueT* at(int x, int y) const { return row((x & 7) * kBlockSize + (y & 7)); }

   private:
    const ValueT* mValues = nullptr;
    int mStride = 0;
    std::array<ValueT, kBlockSize> mTile;
    LeafValues<LeafT> mLeaf;
  };

  /// Where a row of a stencil lies: in which part (see GradientStencilRows), and there in which row.
  struct StencilRow {
    std::uint8_t part, row;
  };
  static constexpr auto kStencilRow = [] {
    std::array<StencilRow, GradientStencil::kPoints * GradientStencil::kPoints> rows{};
    for (int i = 0; i < GradientStencil::kPoints * GradientStencil::kPoints; ++i) {
      const int x = i / GradientStencil::kPoints - 1, y = i % GradientStencil::kPoints - 1;
      rows[i] = {static_cast<std::uint8_t>(3 * GradientStencil::part(x) + GradientStencil::part(y)),
                 static_cast<std::uint8_t>(kBlockSize * (x & 7) + (y & 7))};
    }
    return rows;
  }();

  void readStencil(const Coord& block, const EdgeIndex& edges, GradientStencil& stencil) const {
    const GradientStencilRows needed(edges);
    const typename Table::Around around(mTable, block);
    std::array<std::array<Rows, 3>, 9> parts;
    for (unsigned bits = needed.parts(); bits != 0; bits &= bits - 1) {
      const int part = std::countr_zero(bits);
      for (int z = 0; z < 3; ++z)
        if (z != 0 || needed.below()) parts[part][z].find(mTable, around(part / 3 - 1, part % 3 - 1, z - 1));
    }
    const ValueReader<ValueT> reader = mReader;  // Of its own, so that no store can change it.
    const auto read = [&](auto below) {
      for (const std::uint8_t i : needed.rows()) {
        const auto [part, row] = kStencilRow[i];
        float* to = &stencil.value[GradientStencil::kPoints * i];
        if constexpr (decltype(below)::value) reader.template copy<1>(parts[part][0].row(row) + 7, to);
        reader.template copy<8>(parts[part][1].row(row), to + 1);
        reader.template copy<2>(parts[part][2].row(row), to + 9);
      }
    };
    withSimd(mLevel, [&] {
      if (needed.below()) {
        read(std::true_type{});
      } else {
        read(std::false_type{});
      }
    });
  }

  typename GridT::ConstPtr mGrid;
  GridReading mReading;
  ValueReader<ValueT> mReader;
  Table mTable;
  const SimdLevel mLevel = bestSimdLevel();
  float mLow, mHigh;
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
