#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Where a corner lies: its cell, and its place in it from the cell's centre on, in cells.
struct CellPlace {
  std::uint64_t key;
  Vec3d local;
};

/// Cubic cells with a corner at the origin. The keys of cells hold their steps from the first corner's cell along each
/// axis, 21 bits each.
class CellGrid {
 public:
  explicit CellGrid(double cell) : mCell(cell), mInverse(1 / cell) {}

  [[nodiscard]] double inverse() const { return mInverse; }

  /// \param p finite. \throws Error where it is too far away: see Clustering::add().
  [[nodiscard]] CellPlace place(const Vec3f& p) {
    const Vec3d at = vecCast<double>(p) * mInverse;
    CellPlace result{0, {}};
    bool isNear = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(at[axis] < kFarthest && at[axis] > -kFarthest)) refuse(p);
      const std::int64_t index = floorOf(at[axis]);
      if (!mHasBase) mBase[axis] = index;
      const auto steps = static_cast<std::uint64_t>(index - mBase[axis] + kMostSteps);
      isNear &= steps < 2 * kMostSteps;
      result.key = result.key << kBits | steps;
      result.local[axis] = at[axis] - static_cast<double>(index) - 0.5;
    }
    mHasBase = true;
    if (!isNear) refuse(p);
    return result;
  }

  /// From a place in a cell to coordinates, the nearest that single precision has: the cell may reach beyond them.
  [[nodiscard]] Vec3f position(std::uint64_t key, const Vec3d& local) const {
    constexpr double kMost = std::numeric_limits<float>::max();
    Vec3d p{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto steps = static_cast<std::int64_t>(key >> (kBits * (2 - axis)) & (2 * kMostSteps - 1));
      p[axis] = std::clamp((static_cast<double>(mBase[axis] + steps - kMostSteps) + 0.5 + local[axis]) * mCell, -kMost,
                           kMost);
    }
    return vecCast<float>(p);
  }

 private:
  static constexpr int kBits = 21;
  static constexpr std::int64_t kMostSteps = std::int64_t{1} << (kBits - 1);
  static constexpr double kFarthest = 0x1p50;

  /// Written out, because processors without SSE 4.1 call a function for std::floor.
  static std::int64_t floorOf(double x) {
    const auto i = static_cast<std::int64_t>(x);
    return i - (static_cast<double>(i) > x ? 1 : 0);
  }

  [[noreturn]] void refuse(const Vec3f& p) const;

  double mCell, mInverse;
  std::int64_t mBase[3]{};  ///< The first corner's cell.
  bool mHasBase = false;
};

}  // namespace pdc::detail
