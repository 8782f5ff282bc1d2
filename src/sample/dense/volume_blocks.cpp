#include "sample/dense/volume_blocks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "parallel/gather.h"

namespace pdc::detail {
namespace {

using Parts = std::array<CellMask, kBlockParts>;

Coord partOf(const Coord& block, int part) {
  return {block[0] + (part >> 2), block[1] + (part >> 1 & 1), block[2] + (part & 1)};
}

/// Whether a block's points are not all on one side.
bool isMixed(const VolumeSigns& signs, const Coord& block) {
  const Side own = signs.side(block);
  if (own == Side::kBoth) return true;
  for (int i = 1; i < kBlockParts; ++i) {
    const Coord place = partOf(block, i);
    const Side side = signs.side(place);
    if (side != own && (side != Side::kBoth || sideOfCorners(signs.mask(place), i) != own)) return true;
  }
  return false;
}

/// The points of a block that lie in a volume.
CellMask pointsWithin(const std::array<std::int64_t, 3>& size, const Coord& block) {
  const auto count = [&](int axis) {
    return static_cast<int>(
        std::clamp<std::int64_t>(size[axis] - std::int64_t{kBlockSize} * block[axis], 0, kBlockSize));
  };
  CellMask points;
  if (block[0] < 0 || block[1] < 0 || block[2] < 0) return points;
  for (int x = 0; x < count(0); ++x)
    for (int y = 0; y < count(1); ++y) points.word[x] |= ((std::uint64_t{1} << count(2)) - 1) << kBlockSize * y;
  return points;
}

/// The points of a block that are inside.
CellMask insideOf(const VolumeSampler& values, const Coord& block) {
  CellMask inside;
  const auto count = std::min<std::int64_t>(kBlockSize, values.view().size[2] - std::int64_t{kBlockSize} * block[2]);
  for (int x = 0; x < kBlockSize; ++x)
    for (int y = 0; y < kBlockSize; ++y) {
      const Coord first{kBlockSize * block[0] + x, kBlockSize * block[1] + y, kBlockSize * block[2]};
      std::uint64_t bits = 0;
      if (values.holds(first)) values.insideBits(first, kAxisZ, static_cast<int>(count), &bits);
      inside.word[x] |= bits << kBlockSize * y;
    }
  return inside;
}

}  // namespace

CellMask VolumeData::points(const Coord& block) const {
  CellMask points = pointsWithin(size, block);
  for (const VolumeSigns* signs : {mask, weight}) {
    if (signs == nullptr || signs->side(block) == Side::kInside) continue;
    const CellMask counts = signs->mask(block);
    for (int x = 0; x < kBlockSize; ++x) points.word[x] &= counts.word[x];
  }
  return points;
}

SurfaceBlocks findVolumeBlocks(const VolumeSigns& signs, const VolumeData* data, const Monitor& monitor) {
  SurfaceBlocks out;
  out.open = data != nullptr;
  // A closed surface may lie before the first points.
  const std::int32_t low = out.open ? 0 : -1;
  const Coord& blocks = signs.blocks();
  const auto along = [&](int axis) { return static_cast<std::size_t>(blocks[axis] - low); };
  out.coords = gather<Coord>(along(0) * along(1), [&](std::size_t row, std::vector<Coord>& found) {
    monitor.throwIfStopped();
    Coord block{low + static_cast<std::int32_t>(row / along(1)), low + static_cast<std::int32_t>(row % along(1)), low};
    for (; block[2] < blocks[2]; ++block[2])
      if (isMixed(signs, block)) found.push_back(block);
  });
  out.signs.resize(out.coords.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.coords.size(), 64), [&](const auto& range) {
    monitor.throwIfStopped();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      Parts inside, known;
      for (int part = 0; part < kBlockParts; ++part) {
        inside[part] = signs.mask(partOf(out.coords[i], part));
        if (data != nullptr) known[part] = data->points(partOf(out.coords[i], part));
      }
      joinParts(inside, out.signs[i].row);
      out.signs[i].cells = CellMask::all();
      if (data == nullptr) continue;
      BlockSigns with;
      joinParts(known, with.row);
      out.signs[i].cells = cellsWithAllCorners(with.row);
    }
  });
  if (out.open) dropBlocksWithoutCells(out);
  return out;
}

SurfaceForecast forecastVolumeBlocks(const VolumeSampler& values, const Monitor& monitor) {
  constexpr std::size_t kMostBlocks = 2048;
  const Coord blocks = blocksOf(values.view());
  const auto along = [&](int axis) { return static_cast<std::size_t>(blocks[axis]); };
  const std::size_t total = along(0) * along(1) * along(2), count = std::min(kMostBlocks, total);
  SurfaceForecast some;
  for (std::size_t i = 0; i < count; ++i) {
    monitor.throwIfStopped();
    const std::size_t number = i * total / count;
    const Coord block{static_cast<std::int32_t>(number / along(2) / along(1)),
                      static_cast<std::int32_t>(number / along(2) % along(1)),
                      static_cast<std::int32_t>(number % along(2))};
    const double crossings = crossingsWithin(insideOf(values, block));
    some.crossings += crossings;
    some.blocks += crossings > 0 ? 1 : 0;
  }
  const double weight = static_cast<double>(total) / static_cast<double>(count);
  const double mixed = weight * some.blocks;
  return {.blocks = mixed,
          .crossings = weight * some.crossings,
          .memory = mixed * sizeof(CellMask) + static_cast<double>(total) * sizeof(Side)};
}

}  // namespace pdc::detail
