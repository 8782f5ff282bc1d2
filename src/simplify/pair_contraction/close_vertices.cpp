#include "simplify/pair_contraction/close_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pdc::detail {
namespace {

/// Cells are at least this share of the farthest coordinate, so that their numbers are whole ones and have neighbours.
constexpr double kLeastCell = 0x1p-40;

}  // namespace

CloseVertices::CloseVertices(const std::vector<Vec3d>& positions, const std::vector<std::uint8_t>& used,
                             double distance)
    : mPositions(positions), mDistance(distance) {
  double farthest = 1;
  std::size_t count = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (used[v] == 0) continue;
    ++count;
    for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(positions[v][axis]));
  }
  mInverseCell = 1 / std::max(distance, kLeastCell * farthest);
  mFirst.assign(std::bit_ceil(count + 1) + 1, 0);
  const auto forEachUsed = [&](const auto& visit) {
    for (std::uint32_t v = 0; v < positions.size(); ++v)
      if (used[v] != 0) visit(v, bucketOf(cellOf(positions[v])));
  };
  forEachUsed([&](std::uint32_t, std::size_t bucket) { ++mFirst[bucket]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& first : mFirst) {
    sum += first;
    first = sum;
  }
  // Each bucket is filled from its end on: its entry then is its beginning.
  mVertices.resize(count);
  for (auto v = static_cast<std::uint32_t>(positions.size()); v-- > 0;)
    if (used[v] != 0) mVertices[--mFirst[bucketOf(cellOf(positions[v]))]] = v;
}

Vec3d CloseVertices::cellOf(const Vec3d& p) const {
  return {std::floor(p.x * mInverseCell), std::floor(p.y * mInverseCell), std::floor(p.z * mInverseCell)};
}

std::size_t CloseVertices::bucketOf(const Vec3d& cell) const {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Steele, Lea & Flood 2014, SplitMix.
    h = (h ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis]))) * 0x9E3779B97F4A7C15u;
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
  }
  return static_cast<std::size_t>(h >> 32) & (mFirst.size() - 2);
}

void CloseVertices::addAbove(std::uint32_t vertex, std::vector<std::uint32_t>& found) const {
  const Vec3d& p = mPositions[vertex];
  const Vec3d cell = cellOf(p);
  const std::size_t before = found.size();
  for (int i = 0; i < 27; ++i) {
    const Vec3d step{static_cast<double>(i % 3 - 1), static_cast<double>(i / 3 % 3 - 1),
                     static_cast<double>(i / 9 - 1)};
    const std::size_t bucket = bucketOf(cell + step);
    const auto end = mVertices.begin() + mFirst[bucket + 1];
    for (auto it = std::upper_bound(mVertices.begin() + mFirst[bucket], end, vertex); it != end; ++it)
      if (length(mPositions[*it] - p) < mDistance) found.push_back(*it);
  }
  // Several cells may have one bucket.
  const auto begin = found.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(begin, found.end());
  found.erase(std::unique(begin, found.end()), found.end());
}

}  // namespace pdc::detail
