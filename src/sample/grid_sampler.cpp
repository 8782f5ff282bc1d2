#include "sample/grid_sampler.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <array>
#include <numeric>

#include "sample/grid_leaves.h"
#include "sample/halo.h"
#include "sample/tile_faces.h"

namespace pdc::detail {
namespace {

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
  using Accessor = openvdb::tree::ValueAccessor<const TreeT>;

  TypedGridSampler(typename GridT::ConstPtr grid, const GridReading& reading)
      : mGrid(std::move(grid)), mReading(reading), mReader(reading) {
    const double low = -reading.clamp - reading.iso, high = reading.clamp - reading.iso;
    mLow = static_cast<float>(low + 1e-6 * std::abs(low));
    mHigh = static_cast<float>(high - 1e-6 * std::abs(high));
  }

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    monitor.throwIfStopped();
    const GridLeaves<TreeT> leaves(mGrid->tree(), mReader, mReading.acceptNonFinite);
    monitor.throwIfStopped();
    const std::vector<Coord> candidates = candidateBlocks(leaves, monitor);
    monitor.throwIfStopped();

    // Chunks of candidates find their surface blocks, then move them to where they belong.
    constexpr std::size_t kChunk = 256;
    const std::size_t chunks = (candidates.size() + kChunk - 1) / kChunk;
    std::vector<SurfaceBlocks> found(chunks);
    std::vector<std::size_t> first(chunks + 1);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
      monitor.throwIfStopped();
      Accessor accessor(mGrid->tree());
      BlockSigns signs;
      for (std::size_t i = c * kChunk; i < std::min((c + 1) * kChunk, candidates.size()); ++i)
        if (readSigns(leaves, accessor, candidates[i], signs)) {
          found[c].coords.push_back(candidates[i]);
          found[c].signs.push_back(signs);
        }
      first[c + 1] = found[c].coords.size();
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    SurfaceBlocks out;
    out.open = mReading.open;
    out.coords.resize(first[chunks]);
    out.signs.resize(first[chunks]);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
      std::copy(found[c].coords.begin(), found[c].coords.end(), out.coords.begin() + std::ptrdiff_t(first[c]));
      std::copy(found[c].signs.begin(), found[c].signs.end(), out.signs.begin() + std::ptrdiff_t(first[c]));
    });
    return out;
  }

  void fillHermite(const Coord& block, const EdgeIndex& edges, const LatticeMap& map,
                   HermiteBlock& hermite) const override {
    Halo halo;
    readHalo(block, edges, halo);
    const SlopeLimits limits{mLow, mHigh};
    const auto normalMap = [&map](const Vec3d& x) {
      // Scaled to lattice units, in which gradients are as large as differences of values.
      return inverse(map.jacobian(x)).transposed() * map.voxelSize();
    };
    if (map.affine()) {
      fillFromHalo(halo, edges, limits, toFloat(normalMap({})), hermite);
      return;
    }
    fillFromHalo(halo, edges, limits, Mat3f::identity(), hermite);
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
    std::vector<const LeafT*> leaves;
    mGrid->tree().getNodes(leaves);
    std::vector<Coord> some(std::min(most, leaves.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const openvdb::Coord o = leaves[i * leaves.size() / some.size()]->origin();
      some[i] = blockOf({o.x(), o.y(), o.z()});
    }
    return some;
  }

  void readWindow(const Coord& block, float scale, DistanceWindow& window) const override {
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array<int, 3> kFirst{-DistanceWindow::kReach, 0, kBlockSize},
        kEnd{0, kBlockSize, kBlockPoints + DistanceWindow::kReach};
    Accessor accessor(mGrid->tree());
    Rows rows;
    for (int part = 0; part < 27; ++part) {
      const int px = part / 9, py = part / 3 % 3, pz = part % 3;
      rows.find(accessor, openvdb::Coord((block[0] + px - 1) * kBlockSize, (block[1] + py - 1) * kBlockSize,
                                         (block[2] + pz - 1) * kBlockSize));
      for (int x = kFirst[px]; x < kEnd[px]; ++x)
        for (int y = kFirst[py]; y < kEnd[py]; ++y) {
          std::array<float, kBlockSize> row;
          mReader.template copy<kBlockSize>(rows.at(x, y), row.data());
          for (int z = kFirst[pz]; z < kEnd[pz]; ++z) {
            const float v = row[z & 7];
            window.value[DistanceWindow::index(x, y, z)] = v > mLow && v < mHigh ? v * scale : kUnknown;
          }
        }
    }
  }

 private:
  /// Every block with a cell that could change sign, each once, sorted.
  [[nodiscard]] std::vector<Coord> candidateBlocks(const GridLeaves<TreeT>& leaves, const Monitor& monitor) const {
    std::vector<Coord> blocks = leaves.coords();
    TileFaces<TreeT>(mGrid->tree(), mReader).find(monitor, blocks);
    // A leaf's points are corners of cells of its own block and of the seven blocks below it.
    tbb::enumerable_thread_specific<std::vector<Coord>> missing;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size(), 256), [&](const auto& range) {
      std::vector<Coord>& local = missing.local();
      for (std::size_t l = range.begin(); l != range.end(); ++l)
        for (int i = 1; i < 8; ++i) {
          const Coord& b = leaves.coords()[l];
          const Coord c{b[0] - (i >> 2), b[1] - (i >> 1 & 1), b[2] - (i & 1)};
          if (leaves.find(c) == BlockIndex::kMissing) local.push_back(c);
        }
    });
    for (const std::vector<Coord>& part : missing) blocks.insert(blocks.end(), part.begin(), part.end());
    sortUnique(blocks);
    return blocks;
  }

  /// Gathers a block's 9×9×9 points from the eight leaves or tiles they lie in. \returns true if the block holds
  /// surface.
  bool readSigns(const GridLeaves<TreeT>& leaves, Accessor& accessor, const Coord& block, BlockSigns& signs) const {
    std::array<std::int32_t, 8> leaf;
    std::array<Side, 8> side;
    bool mixed = false;
    const auto origin = [&block](int i) {
      return openvdb::Coord((block[0] + (i >> 2)) * kBlockSize, (block[1] + (i >> 1 & 1)) * kBlockSize,
                            (block[2] + (i & 1)) * kBlockSize);
    };
    for (int i = 0; i < 8; ++i) {
      leaf[i] = leaves.find({block[0] + (i >> 2), block[1] + (i >> 1 & 1), block[2] + (i & 1)});
      if (leaf[i] != BlockIndex::kMissing) {
        side[i] = leaves.side(leaf[i]);
      } else {
        side[i] = mReader.inside(accessor.getValue(origin(i))) ? Side::kInside : Side::kOutside;
      }
      mixed = mixed || side[i] == Side::kBoth || side[i] != side[0];
    }
    if (!mixed) return false;

    std::array<CellMask, 8> inside, active;
    for (int i = 0; i < 8; ++i) {
      if (side[i] == Side::kBoth) {
        inside[i] = leaves.inside(leaf[i]);
      } else {
        inside[i] = side[i] == Side::kInside ? CellMask::all() : CellMask{};
      }
      if (!mReading.open) continue;
      if (leaf[i] != BlockIndex::kMissing) {
        active[i] = leaves.active(leaf[i]);
      } else {
        active[i] = accessor.isValueOn(origin(i)) ? CellMask::all() : CellMask{};
      }
    }
    joinRows(inside, signs.row);
    signs.cells = CellMask::all();
    if (signs.uniform()) return false;
    if (!mReading.open) return true;
    BlockSigns activity;
    joinRows(active, activity.row);
    signs.cells = cellsWithAllCorners(activity);
    return !signs.cells.none();
  }

  static void joinRows(const std::array<CellMask, 8>& part,
                       std::array<std::uint16_t, kBlockPoints * kBlockPoints>& row) {
    for (int x = 0; x < kBlockPoints; ++x)
      for (int y = 0; y < kBlockPoints; ++y) {
        const int i = (x >> 3) << 2 | (y >> 3) << 1;
        const int shift = 8 * (y & 7);
        const std::uint64_t low = part[i].word[x & 7] >> shift & 0xFF, high = part[i | 1].word[x & 7] >> shift & 1;
        row[kBlockPoints * x + y] = static_cast<std::uint16_t>(low | high << 8);
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

  /// A neighbouring block's rows of eight values along z; those of a tile are all the same.
  class Rows {
   public:
    void find(Accessor& accessor, const openvdb::Coord& origin) {
      const LeafT* leaf = accessor.probeConstLeaf(origin);
      mStride = leaf == nullptr ? 0 : kBlockSize;
      if (leaf == nullptr) mTile.fill(accessor.getValue(origin));
      mValues = leaf == nullptr ? mTile.data() : mLeaf.read(*leaf);
    }
    [[nodiscard]] const ValueT* at(int x, int y) const { return mValues + mStride * ((x & 7) * kBlockSize + (y & 7)); }

   private:
    const ValueT* mValues = nullptr;
    int mStride = 0;
    std::array<ValueT, kBlockSize> mTile;
    LeafValues<LeafT> mLeaf;
  };

  void readHalo(const Coord& block, const EdgeIndex& edges, Halo& halo) const {
    const HaloRows needed(edges);
    Accessor accessor(mGrid->tree());
    for (int px = -1; px <= 1; ++px)
      for (int py = -1; py <= 1; ++py) {
        // On each axis: the last point of the block below, the eight of the block, the first two of the block above.
        constexpr std::array<int, 3> kFirst{-1, 0, 8}, kEnd{0, 8, 10};
        const int endX = kEnd[px + 1], firstY = kFirst[py + 1], endY = kEnd[py + 1];
        if (!needed.any(kFirst[px + 1], endX, firstY, endY)) continue;
        std::array<Rows, 3> rows;
        for (int pz = 0; pz < 3; ++pz)
          if (pz != 0 || needed.below())
            rows[pz].find(accessor, openvdb::Coord((block[0] + px) * kBlockSize, (block[1] + py) * kBlockSize,
                                                   (block[2] + pz - 1) * kBlockSize));
        for (int x = kFirst[px + 1]; x < endX; ++x)
          for (int y = firstY; y < endY; ++y) {
            if (!needed.row(x, y)) continue;
            float* to = &halo.value[Halo::index(x, y, -1)];
            if (needed.below()) mReader.template copy<1>(rows[0].at(x, y) + 7, to);
            mReader.template copy<8>(rows[1].at(x, y), to + 1);
            mReader.template copy<2>(rows[2].at(x, y), to + 9);
          }
      }
  }

  static Mat3f toFloat(const Mat3d& m) {
    return {{vecCast<float>(m.row[0]), vecCast<float>(m.row[1]), vecCast<float>(m.row[2])}};
  }

  typename GridT::ConstPtr mGrid;
  GridReading mReading;
  ValueReader<ValueT> mReader;
  float mLow, mHigh;
};

template <typename GridT>
std::unique_ptr<const GridSampler> tryMake(const openvdb::GridBase::ConstPtr& grid, const GridReading& reading) {
  if (!grid->isType<GridT>()) return nullptr;
  return std::make_unique<TypedGridSampler<GridT>>(openvdb::GridBase::constGrid<GridT>(grid), reading);
}

}  // namespace

std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid,
                                                   const GridReading& reading) {
  if (auto s = tryMake<openvdb::FloatGrid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::DoubleGrid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::Int32Grid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::Int64Grid>(grid, reading)) return s;
  return tryMake<openvdb::BoolGrid>(grid, reading);
}

}  // namespace pdc::detail
