#include "sample/implicit/missing_points.h"

#include <fmt/format.h>

#include "field/non_finite.h"
#include "parallel/sort_unique.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc::detail {
namespace {

constexpr int kBits = 21;
static_assert(kMaxVoxelsPerAxis < 1 << kBits);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

std::uint64_t key(const Coord& point) {
  return (static_cast<std::uint64_t>(point[0]) << kBits | static_cast<std::uint64_t>(point[1])) << kBits |
         static_cast<std::uint64_t>(point[2]);
}

}  // namespace

void MissingPoints::add(const Coord& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] > mCells[axis]) return;
  mAdded.local().push_back(key(point));
}

void MissingPoints::throwIfMany() {
  std::size_t added = 0;
  for (const auto& points : mAdded) added += points.size();
  if (added <= kMostCountedPoints) return;
  gather();
  if (mPoints.size() > kMostCountedPoints) fail();
}

void MissingPoints::throwIfAny() {
  gather();
  if (!mPoints.empty()) fail();
}

void MissingPoints::gather() {
  for (auto& points : mAdded) {
    mPoints.insert(mPoints.end(), points.begin(), points.end());
    points.clear();
  }
  sortUnique(mPoints);
}

void MissingPoints::fail() const {
  const std::uint64_t first = mPoints.front();
  Vec3d at;
  for (int axis = 0; axis < 3; ++axis)
    at[axis] = mFrame.at(axis, static_cast<double>(first >> kBits * (2 - axis) & kMask));
  failNonFinite(mPoints.size(), {"value at a lattice point", "values at lattice points"},
                fmt::format("({:.9g}, {:.9g}, {:.9g})", at.x, at.y, at.z), mFunction.valueAt(at));
}

}  // namespace pdc::detail
