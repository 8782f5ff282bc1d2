#include <openvdb/openvdb.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "sample/meaning/active_values.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/meaning/grid_meaning.h"
#include "sample/meaning/slope_sample.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kSampledLeaves = 64;

/// What the sampled leaves say.
template <typename LeafT>
class LeafSample {
 public:
  LeafSample(const LatticeMap& map, double background) : mMap(map), mBackground(background) {}

  void addValues(const LeafT& leaf) {
    mRange.add(rangeOf(leaf));
    const double beyond = (1 + kAtBandEnd) * std::abs(mBackground);
    for (int x = 0; x < kSide; ++x) {
      const std::uint64_t active = activeAt(leaf, x);
      mValues += static_cast<std::size_t>(std::popcount(active));
      int count = 0;
      for (int i = 0; i < 64; ++i) count += int(std::abs(value(leaf, 64 * x + i)) > beyond) & int(active >> i & 1);
      mBeyond += static_cast<std::size_t>(count);
    }
  }
  /// To be called when addValues() was for all leaves.
  void addNeighbours(const LeafT& leaf) {
    if (!mSlopes) mSlopes.emplace(mRange);
    const openvdb::Coord o = leaf.origin();
    constexpr double kMiddle = 0.5 * (kSide - 1);
    const Mat3d toWorld = inverse(mMap.jacobian({o.x() + kMiddle, o.y() + kMiddle, o.z() + kMiddle})).transposed();
    for (int x = 0; x < kSide; ++x) {
      const std::uint64_t active = activeAt(leaf, x);
      std::uint64_t surrounded = active;
      for (const Neighbours& n : neighbours(leaf, x)) {
        visitBits(active & n.inLeaf & ~n.active, [&](int i) { countEnd(leaf, 64 * x + i, n.step); });
        surrounded &= n.inLeaf & n.active;
      }
      // Half of them, in a pattern that sees each row, say as much.
      constexpr std::uint64_t kEven = 0x5555555555555555;
      visitBits(surrounded & (x % 2 == 0 ? kEven : ~kEven), [&](int i) { addSlope(leaf, 64 * x + i, toWorld); });
    }
  }
  void finish(GridEvidence& evidence) {
    evidence.low = mRange.low;
    evidence.high = mRange.high;
    evidence.ends = mEnds;
    if (mValues > 0) evidence.beyondBackground = static_cast<double>(mBeyond) / static_cast<double>(mValues);
    if (mSlopes) mSlopes->finish(evidence);
  }

 private:
  static constexpr int kSide = LeafT::DIM;
  static constexpr int kStep[3] = {kSide * kSide, kSide, 1};

  static_assert(kSide == 8, "A layer across x is one word of a mask.");

  /// The points beside those of a layer, on one side.
  struct Neighbours {
    int step;              ///< From a point to its neighbour.
    std::uint64_t inLeaf;  ///< Points of the layer whose neighbours the leaf holds.
    std::uint64_t active;  ///< Points of the layer whose neighbours are active.
  };

  static std::uint64_t activeAt(const LeafT& leaf, int x) {
    return leaf.getValueMask().template getWord<std::uint64_t>(static_cast<openvdb::Index>(x));
  }

  static std::array<Neighbours, 6> neighbours(const LeafT& leaf, int x) {
    constexpr std::uint64_t kAll = ~std::uint64_t{0}, kFirstZ = 0x0101010101010101, kLastZ = kFirstZ << 7;
    const std::uint64_t w = activeAt(leaf, x);
    const bool below = x > 0, above = x + 1 < kSide;
    return {{{-kStep[0], below ? kAll : 0, below ? activeAt(leaf, x - 1) : 0},
             {kStep[0], above ? kAll : 0, above ? activeAt(leaf, x + 1) : 0},
             {-kStep[1], kAll << 8, w << 8},
             {kStep[1], kAll >> 8, w >> 8},
             {-kStep[2], ~kFirstZ, w << 1},
             {kStep[2], ~kLastZ, w >> 1}}};
  }

  template <typename Visit>
  static void visitBits(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
  }

  static double value(const LeafT& leaf, int i) { return static_cast<double>(leaf.buffer().data()[i]); }

  void countEnd(const LeafT& leaf, int i, int step) {
    const double v = value(leaf, i), next = value(leaf, i + step);
    if (v != 0 && next != 0 && v == v && next == next) ++mEnds[v > 0][next > 0];
  }

  /// Adds the slope at a point whose neighbours are all active, unless one of them carries none.
  void addSlope(const LeafT& leaf, int i, const Mat3d& toWorld) {
    const double v = value(leaf, i);
    if (!mSlopes->isInBand(v)) return;
    Vec3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = value(leaf, i - kStep[axis]), above = value(leaf, i + kStep[axis]);
      if (!mSlopes->isInBand(below) || !mSlopes->isInBand(above)) return;
      gradient[axis] = 0.5 * (above - below);
    }
    mSlopes->add(length(toWorld * gradient), v);
  }

  const LatticeMap& mMap;
  double mBackground;
  ValueRange mRange;
  std::size_t mValues = 0, mBeyond = 0;
  std::optional<SlopeSample> mSlopes;  ///< Made when the range is known.
  std::array<std::array<std::size_t, 2>, 2> mEnds{};
};

using Counts = std::function<bool(const openvdb::Coord&)>;

/// Says of points whether their weight is above zero.
Counts hasWeight(const openvdb::GridBase* weight) {
  Counts counts = [](const openvdb::Coord&) { return true; };
  if (weight == nullptr) return counts;
  visitContourable(*weight, [&](const auto& typed) {
    counts = [accessor = typed.getConstAccessor()](const openvdb::Coord& c) { return accessor.getValue(c) > 0; };
  });
  return counts;
}

template <typename TreeT>
void gatherFromTree(const TreeT& tree, const LatticeMap& map, const std::optional<GridClass>& known,
                    const Counts& counts, GridEvidence& evidence) {
  using LeafT = typename TreeT::LeafNodeType;
  const ActiveValues<TreeT> values(tree);
  const std::vector<const LeafT*> some = values.someLeaves(kSampledLeaves);
  LeafSample<LeafT> sample(map, evidence.background);
  for (const LeafT* leaf : some) sample.addValues(*leaf);
  for (const LeafT* leaf : some) sample.addNeighbours(*leaf);
  sample.finish(evidence);
  ValueRange range;
  range.add(evidence.background);
  range.add(evidence.low);
  range.add(evidence.high);
  // A sample may miss the few values that are inside.
  if (!known || (known == GridClass::kLevelSet && range.low >= 0)) {
    const ValueRange whole = values.range();
    range.add(whole.low);
    range.add(whole.high);
  }
  evidence.low = range.low;
  evidence.high = range.high;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool last : {false, true}) values.outermost(axis, last, counts, evidence.outermost);
}

}  // namespace

GridEvidence gatherEvidence(const openvdb::GridBase& grid, const LatticeMap& map, const std::optional<GridClass>& known,
                            const openvdb::GridBase* weight) {
  GridEvidence evidence;
  evidence.voxelSize = map.voxelSize();
  visitContourable(grid, [&](const auto& typed) {
    evidence.background = static_cast<double>(typed.background());
    using TreeT = typename std::decay_t<decltype(typed)>::TreeType;
    if constexpr (std::is_same_v<typename TreeT::ValueType, bool>) {
      evidence.mask = true;
    } else {
      gatherFromTree(typed.tree(), map, known, hasWeight(weight), evidence);
    }
  });
  return evidence;
}

}  // namespace pdc::detail
