#include <openvdb/openvdb.h>

#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>

#include "sample/meaning/active_values.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/meaning/grid_meaning.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kSampledLeaves = 64;
/// A sample of fewer slopes says nothing.
constexpr std::size_t kLeastSlopes = 32;
/// Values as near as this to the end of a band stand for all beyond.
constexpr double kAtEnd = 1e-3;

/// \returns 0 if there are too few to say something.
double median(std::vector<double> values) {
  if (values.size() < kLeastSlopes) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What the sampled leaves say.
template <typename LeafT>
class LeafSample {
 public:
  LeafSample(const LatticeMap& map, double background) : mMap(map), mBackground(background) {}

  void addValues(const LeafT& leaf) {
    for (auto value = leaf.cbeginValueOn(); value; ++value) {
      const auto v = static_cast<double>(*value);
      mRange.add(v);
      ++mValues;
      mBeyond += std::abs(v) > (1 + kAtEnd) * std::abs(mBackground);
    }
  }
  /// To be called when addValues() was for all leaves.
  void addNeighbours(const LeafT& leaf) {
    const openvdb::Coord o = leaf.origin();
    constexpr double kMiddle = 0.5 * (LeafT::DIM - 1);
    const Mat3d toWorld = inverse(mMap.jacobian({o.x() + kMiddle, o.y() + kMiddle, o.z() + kMiddle})).transposed();
    for (int i = 0; i < kSize; ++i) {
      if (!leaf.isValueOn(static_cast<openvdb::Index>(i))) continue;
      Vec3d gradient;
      bool known = isInBand(value(leaf, i));
      for (int axis = 0; axis < 3; ++axis) {
        const int at = i / kStep[axis] % kSide;
        for (const int s : {-1, 1})
          known = visitNeighbour(leaf, i, at + s >= 0 && at + s < kSide ? s * kStep[axis] : 0) && known;
        if (known) gradient[axis] = 0.5 * (value(leaf, i + kStep[axis]) - value(leaf, i - kStep[axis]));
      }
      if (!known) continue;
      mSlopes.push_back(length(toWorld * gradient));
      mSizes.push_back(std::abs(value(leaf, i)));
    }
  }
  void finish(GridEvidence& evidence) {
    evidence.low = mRange.low;
    evidence.high = mRange.high;
    evidence.ends = mEnds;
    if (mValues > 0) evidence.beyondBackground = static_cast<double>(mBeyond) / static_cast<double>(mValues);
    evidence.slope = median(mSlopes);
    if (!(evidence.slope > 0)) return;
    std::vector<double> atZero;
    for (std::size_t i = 0; i < mSlopes.size(); ++i)
      if (mSizes[i] < evidence.slope * evidence.voxelSize) atZero.push_back(mSlopes[i]);
    evidence.slopeAtZero = median(std::move(atZero));
    for (double& slope : mSlopes) slope = std::abs(slope / evidence.slope - 1);
    evidence.slopeSpread = median(std::move(mSlopes));
  }

 private:
  static constexpr int kSide = LeafT::DIM, kSize = LeafT::SIZE;
  static constexpr int kStep[3] = {kSide * kSide, kSide, 1};

  static double value(const LeafT& leaf, int i) {
    return static_cast<double>(leaf.getValue(static_cast<openvdb::Index>(i)));
  }

  /// False for values that are clamped, at one of the ends of what there is.
  [[nodiscard]] bool isInBand(double v) const {
    const double margin = kAtEnd * (mRange.high - mRange.low);
    return v > mRange.low + margin && v < mRange.high - margin;
  }

  /// Counts where activity ends. \returns whether the neighbour is active and carries slope. \param step 0 if it lies
  /// in another leaf.
  bool visitNeighbour(const LeafT& leaf, int i, int step) {
    if (step == 0) return false;
    const double v = value(leaf, i), next = value(leaf, i + step);
    if (leaf.isValueOn(static_cast<openvdb::Index>(i + step))) return isInBand(next);
    if (v != 0 && next != 0 && v == v && next == next) ++mEnds[v > 0][next > 0];
    return false;
  }

  const LatticeMap& mMap;
  double mBackground;
  ValueRange mRange;
  std::size_t mValues = 0, mBeyond = 0;
  std::vector<double> mSlopes, mSizes;  ///< One of each for every value that has a slope.
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
