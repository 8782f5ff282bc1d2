#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "pdc/mesh/buffer.h"
#include "pdc/monitor.h"
#include "pdc/sample/hermite_block.h"
#include "sample/dense/volume_sampler.h"
#include "sample/stencils/block_parts.h"

namespace pdc::detail {

/// Which points of a volume are inside. Takes a bit a voxel, and memory is touched only for blocks with points on both
/// sides.
class VolumeSigns {
 public:
  /// Reads all values once, in parallel, in the order in which they lie in memory. \param data null, or which points
  /// count: all others are outside. \throws Cancelled.
  VolumeSigns(const VolumeSampler& values, const VolumeSigns* data, const Monitor& monitor);

  /// Adds the points on the isovalue that lie between two that are strictly inside: see isovalue_points.h.
  void addPointsBetween(const VolumeSampler& values, const VolumeSigns* data);

  /// Whether all values are finite.
  [[nodiscard]] bool allFinite() const { return mAllFinite; }
  /// Blocks along each axis.
  [[nodiscard]] const Coord& blocks() const { return mBlocks; }
  /// Where the points of a block lie; all beyond the volume is outside.
  [[nodiscard]] Side side(const Coord& block) const { return holds(block) ? mSide[number(block)] : Side::kOutside; }
  [[nodiscard]] CellMask mask(const Coord& block) const {
    if (!holds(block)) return {};
    const std::size_t i = number(block);
    return mSide[i] == Side::kBoth ? mInside[i] : mSide[i] == Side::kInside ? CellMask::all() : CellMask{};
  }
  [[nodiscard]] bool inside(const Coord& point) const;

 private:
  class RowReader;

  [[nodiscard]] bool holds(const Coord& b) const {
    return b[0] >= 0 && b[1] >= 0 && b[2] >= 0 && b[0] < mBlocks[0] && b[1] < mBlocks[1] && b[2] < mBlocks[2];
  }
  [[nodiscard]] std::size_t number(const Coord& b) const {
    return (static_cast<std::size_t>(b[0]) * static_cast<std::size_t>(mBlocks[1]) + static_cast<std::size_t>(b[1])) *
               static_cast<std::size_t>(mBlocks[2]) +
           static_cast<std::size_t>(b[2]);
  }
  void set(const Coord& block, const CellMask& inside);
  void keepOnly(const VolumeSigns& data, const Monitor& monitor);
  [[nodiscard]] CellMask pointsBetween(const Coord& block, const VolumeSampler& values, const VolumeSigns* data) const;

  Coord mBlocks;
  Buffer<Side> mSide;
  Buffer<CellMask> mInside;  ///< By block; not set where all points are on one side.
  bool mAllFinite = true;
  std::vector<Coord> mOnIso;  ///< Blocks that may hold values on the isovalue, in any order.
};

/// Blocks of so many points.
[[nodiscard]] Coord blocksOf(const VolumeView& view);

}  // namespace pdc::detail
