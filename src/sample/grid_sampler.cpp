#include "sample/grid_sampler.h"

#include <array>

#include "sample/grid_leaves.h"

namespace pdc::detail {
namespace {

/// A block's points and their neighbours: lattice points -1 to 9 on each axis.
constexpr int kHalo = kBlockPoints + 2;

constexpr int haloIndex(int x, int y, int z) { return (kHalo * (x + 1) + y + 1) * kHalo + z + 1; }
constexpr std::array<int, 3> kHaloStep{kHalo * kHalo, kHalo, 1};

template <typename GridT>
class TypedGridSampler final : public GridSampler {
 public:
  using TreeT = typename GridT::TreeType;
  using ValueT = typename TreeT::ValueType;
  using LeafT = typename TreeT::LeafNodeType;
  using Accessor = openvdb::tree::ValueAccessor<const TreeT>;

  TypedGridSampler(typename GridT::ConstPtr grid, const GridReading& reading)
      : mGrid(std::move(grid)), mReader{reading} {
    const double low = -reading.clamp - reading.iso, high = reading.clamp - reading.iso;
    mLow = static_cast<float>(low + 1e-6 * std::abs(low));
    mHigh = static_cast<float>(high - 1e-6 * std::abs(high));
  }

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override {
    monitor.throwIfStopped();
    const GridLeaves<TreeT> leaves(mGrid->tree(), mReader);
    monitor.throwIfStopped();
    std::vector<Coord> candidates = candidateBlocks(leaves, monitor);
    monitor.throwIfStopped();

    Buffer<BlockSigns> signs(candidates.size());
    std::vector<char> keep(candidates.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64), [&](const auto& range) {
      monitor.throwIfStopped();
      Accessor accessor(mGrid->tree());
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        keep[i] = readSigns(leaves, accessor, candidates[i], signs[i]);
    });

    SurfaceBlocks out;
    out.open = mReader.reading.open;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!keep[i]) continue;
      out.coords.push_back(candidates[i]);
      out.signs.push_back(signs[i]);
    }
    return out;
  }

  void fillHermite(const Coord& block, const EdgeIndex& edges, const LatticeMap& map,
                   HermiteBlock& hermite) const override {
    std::array<float, kHalo * kHalo * kHalo> values;
    readHalo(block, values);
    const bool affine = map.affine();
    Mat3d normalMap;
    if (affine) normalMap = inverse(map.jacobian({})).transposed();
    edges.forEach([&](int i, int axis, int x, int y, int z) {
      const float* p = &values[haloIndex(x, y, z)];
      const float t = crossing(p[0], p[kHaloStep[axis]]);
      hermite.t[i] = t;
      if (!affine) {
        Vec3d at{8.0 * block[0] + x, 8.0 * block[1] + y, 8.0 * block[2] + z};
        at[axis] += t;
        normalMap = inverse(map.jacobian(at)).transposed();
      }
      const Vec3d g = normalMap * gradient(p, axis, t);
      const double l = length(g);
      const Vec3d n = l > 0 && std::isfinite(l) ? g * (1 / l) : Vec3d{};
      hermite.nx[i] = static_cast<float>(n.x);
      hermite.ny[i] = static_cast<float>(n.y);
      hermite.nz[i] = static_cast<float>(n.z);
    });
  }

 private:
  /// Every block with a cell that could change sign, each once, sorted.
  [[nodiscard]] std::vector<Coord> candidateBlocks(const GridLeaves<TreeT>& leaves, const Monitor& monitor) const {
    std::vector<Coord> blocks;
    findTileFaces(mGrid->tree(), mReader, monitor, blocks);
    // A leaf's points are corners of cells of its own block and of the seven blocks below it.
    for (const Coord& b : leaves.coords())
      for (int i = 0; i < 8; ++i) {
        const Coord c{b[0] - (i >> 2), b[1] - (i >> 1 & 1), b[2] - (i & 1)};
        if (i == 0 || leaves.find(c) == BlockIndex::kMissing) blocks.push_back(c);
      }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  /// Gathers a block's 9×9×9 points from the eight leaves or tiles they lie in. \returns true if the block holds
  /// surface.
  bool readSigns(const GridLeaves<TreeT>& leaves, Accessor& accessor, const Coord& block, BlockSigns& signs) const {
    std::array<CellMask, 8> inside, active;
    for (int i = 0; i < 8; ++i) {
      const Coord c{block[0] + (i >> 2), block[1] + (i >> 1 & 1), block[2] + (i & 1)};
      const std::int32_t leaf = leaves.find(c);
      if (leaf != BlockIndex::kMissing) {
        inside[i] = leaves.inside(leaf);
        if (mReader.reading.open) active[i] = leaves.active(leaf);
      } else {
        const openvdb::Coord p(c[0] * kBlockSize, c[1] * kBlockSize, c[2] * kBlockSize);
        inside[i] = mReader.inside(accessor.getValue(p)) ? CellMask::all() : CellMask{};
        if (mReader.reading.open) active[i] = accessor.isValueOn(p) ? CellMask::all() : CellMask{};
      }
    }
    joinRows(inside, signs.row);
    signs.cells = CellMask::all();
    if (signs.uniform()) return false;
    if (!mReader.reading.open) return true;
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

  void readHalo(const Coord& block, std::array<float, kHalo * kHalo * kHalo>& values) const {
    Accessor accessor(mGrid->tree());
    // On each axis: the last point of the block below, the eight of the block, and the first two of the block above.
    constexpr int kFirst[3] = {-1, 0, 8}, kCount[3] = {1, 8, 2};
    for (int i = 0; i < 27; ++i) {
      const std::array<int, 3> part{i / 9, i / 3 % 3, i % 3};
      const openvdb::Coord origin((block[0] + part[0] - 1) * kBlockSize, (block[1] + part[1] - 1) * kBlockSize,
                                  (block[2] + part[2] - 1) * kBlockSize);
      const LeafT* leaf = accessor.probeConstLeaf(origin);
      const LeafValues<LeafT> stored(leaf);
      const float tile = leaf == nullptr ? mReader.value(accessor.getValue(origin)) : 0;
      for (int x = kFirst[part[0]]; x < kFirst[part[0]] + kCount[part[0]]; ++x)
        for (int y = kFirst[part[1]]; y < kFirst[part[1]] + kCount[part[1]]; ++y) {
          const int z = kFirst[part[2]];
          float* to = &values[haloIndex(x, y, z)];
          if (leaf == nullptr) {
            std::fill_n(to, kCount[part[2]], tile);
          } else {
            const auto offset = static_cast<openvdb::Index>((x & 7) << 6 | (y & 7) << 3 | (z & 7));
            for (int k = 0; k < kCount[part[2]]; ++k) to[k] = mReader.value(stored[offset + k]);
          }
        }
    }
  }

  /// Where the linear function with values v0 and v1 at the ends is zero.
  static float crossing(float v0, float v1) {
    const float t = v0 / (v0 - v1);
    return t >= 0 && t <= 1 ? t : 0.5F;  // NaN: an end is not finite, or both are zero to single precision.
  }

  /// True for values that a slope may be taken from.
  [[nodiscard]] bool usable(float v) const { return v > mLow && v < mHigh; }

  /// Slope at p along a lattice direction: central, or one-sided where a neighbour is clamped.
  [[nodiscard]] float slope(const float* p, int step) const {
    const float below = p[-step], here = p[0], above = p[step];
    const bool useBelow = usable(below), useAbove = usable(above);
    if (useBelow == useAbove) return useBelow || !usable(here) ? 0.5F * (above - below) : 0.0F;
    if (!usable(here)) return 0.5F * (above - below);
    return useBelow ? here - below : above - here;
  }

  /// Gradient in lattice units, at t along the edge from p: of the trilinear interpolant, averaged over the four cells
  /// there.
  [[nodiscard]] Vec3d gradient(const float* p, int axis, float t) const {
    const float* q = p + kHaloStep[axis];
    Vec3d g;
    g[axis] = q[0] - p[0];
    for (int k = 1; k < 3; ++k) {
      const int other = (axis + k) % 3, step = kHaloStep[other];
      g[other] = (1 - t) * slope(p, step) + t * slope(q, step);
    }
    return g;
  }

  typename GridT::ConstPtr mGrid;
  ValueReader<ValueT> mReader;
  float mLow, mHigh;
};

template <typename GridT>
std::unique_ptr<const GridSampler> tryMake(const openvdb::GridBase::ConstPtr& grid, const GridReading& reading) {
  if (!grid->isType<GridT>()) return nullptr;
  return std::make_unique<TypedGridSampler<GridT>>(openvdb::GridBase::constGrid<GridT>(grid), reading);
}

}  // namespace

std::unique_ptr<const GridSampler> makeGridSampler(openvdb::GridBase::ConstPtr grid, const GridReading& reading) {
  if (auto s = tryMake<openvdb::FloatGrid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::DoubleGrid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::Int32Grid>(grid, reading)) return s;
  if (auto s = tryMake<openvdb::Int64Grid>(grid, reading)) return s;
  return tryMake<openvdb::BoolGrid>(grid, reading);
}

}  // namespace pdc::detail
