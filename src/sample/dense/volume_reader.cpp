#include "sample/dense/volume_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "parallel/gather.h"
#include "sample/block_hash.h"
#include "sample/block_index.h"
#include "sample/stencils/isovalue_points.h"

namespace pdc::detail {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Whether all points of a box have data.
bool allInside(const VolumeSigns& mask, const PointRows& box) {
  const Coord low = blockOf(box.low);
  const Coord high =
      blockOf({box.low[0] + box.size[0] - 1, box.low[1] + box.size[1] - 1, box.low[2] + box.size[2] - 1});
  for (std::int32_t x = low[0]; x <= high[0]; ++x)
    for (std::int32_t y = low[1]; y <= high[1]; ++y)
      for (std::int32_t z = low[2]; z <= high[2]; ++z)
        if (mask.side({x, y, z}) != Side::kInside) return false;
  return true;
}

}  // namespace

void VolumeReader::read(const PointRows& box) const {
  mSampler->read(box);
  if (mMask == nullptr || allInside(*mMask, box)) return;
  for (int x = 0; x < box.size[0]; ++x)
    for (unsigned ys = box.rows[x]; ys != 0; ys &= ys - 1) {
      const int y = std::countr_zero(ys);
      float* row = box.to + x * box.step[0] + y * box.step[1];
      for (int z = 0; z < box.size[2]; ++z)
        if (!mMask->inside({box.low[0] + x, box.low[1] + y, box.low[2] + z})) row[z] = kUnknown;
    }
}

void VolumeReader::readGradients(const Coord& block, const EdgeIndex& edges, GradientStencil& stencil) const {
  constexpr int n = GradientStencil::kPoints;
  const GradientStencilRows needed(edges);
  std::array<std::uint16_t, n> rows{};
  for (const std::uint8_t row : needed.rows()) rows[row / n] |= static_cast<std::uint16_t>(1U << row % n);
  read({.low = {kBlockSize * block[0] - 1, kBlockSize * block[1] - 1, kBlockSize * block[2] - 1},
        .size = {n, n, n},
        .rows = rows.data(),
        .to = stencil.value.data(),
        .step = {GradientStencil::kStep[0], GradientStencil::kStep[1]}});
}

void VolumeReader::readDistances(const Coord& block, float scale, DistanceStencil& stencil) const {
  constexpr int n = DistanceStencil::kPoints, kReach = DistanceStencil::kReach;
  read({.low = {kBlockSize * block[0] - kReach, kBlockSize * block[1] - kReach,
                kBlockSize * block[2] - DistanceStencil::kBelow},
        .size = {n, n, kLanes},
        .rows = stencil.rows.data(),
        .to = stencil.value.data(),
        .step = {DistanceStencil::kStep[0], DistanceStencil::kStep[1]}});
  scaleKnown(mLimits, scale, stencil);
  fillIsovaluePoints(stencil);
}

void VolumeReader::prefetch(const Coord& block) const {
  const Axis run = runAxis(mSampler->view());
  const Axis u = nextAxis(run), v = previousAxis(run);
  Coord p{kBlockSize * block[0], kBlockSize * block[1], kBlockSize * block[2]};
  p[run] = std::max(p[run], 0);
  const Coord low = p;
  for (p[u] = low[u]; p[u] < low[u] + kBlockSize; ++p[u])
    for (p[v] = low[v]; p[v] < low[v] + kBlockSize; ++p[v])
      if (mSampler->holds(p)) __builtin_prefetch(mSampler->at(p));
}

std::vector<Coord> VolumeReader::someBlocks(std::size_t most) const {
  using Hashed = std::pair<std::uint64_t, Coord>;
  constexpr std::uint64_t kLookedAt = 1 << 17, kAll = std::numeric_limits<std::uint64_t>::max();
  const Coord blocks = blocksOf(mSampler->view());
  const auto along = [&](int axis) { return static_cast<std::uint64_t>(blocks[axis]); };
  const std::uint64_t total = along(0) * along(1) * along(2);
  const std::uint64_t limit = total <= kLookedAt ? kAll : kAll / total * kLookedAt;
  std::vector<Hashed> hashed = gather<Hashed>(along(0) * along(1), [&](std::size_t row, std::vector<Hashed>& found) {
    Coord block{static_cast<std::int32_t>(row / along(1)), static_cast<std::int32_t>(row % along(1)), 0};
    for (; block[2] < blocks[2]; ++block[2])
      if (const std::uint64_t hash = blockHash(block); hash <= limit) found.emplace_back(hash, block);
  });
  std::sort(hashed.begin(), hashed.end());
  std::vector<Coord> some;
  for (const Hashed& h : hashed) {
    if (some.size() == most) break;
    if (!isConstant(h.second)) some.push_back(h.second);
  }
  return some;
}

bool VolumeReader::isConstant(const Coord& block) const {
  std::array<float, kBlockCells> values;
  std::array<std::uint16_t, kBlockSize> rows;
  rows.fill((1U << kBlockSize) - 1);
  read({.low = {kBlockSize * block[0], kBlockSize * block[1], kBlockSize * block[2]},
        .size = {kBlockSize, kBlockSize, kBlockSize},
        .rows = rows.data(),
        .to = values.data(),
        .step = {kBlockSize * kBlockSize, kBlockSize}});
  const float first = values[0];
  return std::all_of(values.begin(), values.end(), [&](float v) { return v == first || std::isnan(v); });
}

}  // namespace pdc::detail
