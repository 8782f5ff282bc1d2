#include "points/spatial_order.h"

#include <algorithm>
#include <cmath>

#include "pdc/math/box.h"

namespace pdc::detail {
namespace {

constexpr int kBits = 21;  ///< Per axis: three make 63.

/// The bits of a number, two zeros between any two.
std::uint64_t spread(std::uint64_t bits) {
  bits &= (std::uint64_t{1} << kBits) - 1;
  bits = (bits | bits << 32) & 0x1f00000000ffffU;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2) & 0x1249249249249249U;
}

}  // namespace

Buffer<PointCode> pointCodes(std::span<const Vec3d> points) {
  Box box = Box::empty();
  for (const Vec3d& p : points) box.include(p);
  const double side = points.empty() ? 0 : 2 * largestEntry(box.halfSize());
  constexpr double kCells = std::uint64_t{1} << kBits;
  const auto cell = [&](double distance) {
    const double at = side > 0 ? distance / side * kCells : 0;
    return spread(static_cast<std::uint64_t>(std::min(at, kCells - 1)));
  };
  Buffer<PointCode> codes(points.size());
  forEachInParallel(points.size(), 4096, [&](std::uint32_t i) {
    const Vec3d d = points[i] - box.lo;
    codes[i] = {cell(d.x) << 2 | cell(d.y) << 1 | cell(d.z), i};
  });
  return codes;
}

}  // namespace pdc::detail
