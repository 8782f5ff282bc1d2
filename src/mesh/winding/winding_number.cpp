#include "mesh/winding/winding_number.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/winding/lattice_line.h"

namespace pdc::detail {
namespace {

Buffer<std::uint32_t> allTriangles(const ClosedSurface& surface) {
  Buffer<std::uint32_t> numbers(surface.surface.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

BoxF boxOf(const ClosedSurface& surface) {
  BoxF box = BoxF::empty();
  for (const Triangle& t : surface.surface.triangles)
    for (const std::uint32_t v : t) box.include(surface.surface.positions[v]);
  return box;
}

/// Single precision numbers below and above.
float below(double v) { return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::infinity()); }
float above(double v) { return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::infinity()); }

}  // namespace

WindingNumber::WindingNumber(const ClosedSurface& surface)
    : mSurface(surface),
      mTree(surface.surface, allTriangles(surface)),
      mCaps(surface, surface.caps()),
      mBox(boxOf(surface)) {}

int WindingNumber::whole(const Vec3d& p) const {
  if (mBox.squaredDistance(p) > 0) return 0;
  const BoxF ray{{below(p.x), below(p.y), below(p.z)}, {above(p.x), above(p.y), mBox.hi.z}};
  int number = 0;
  mTree.visitMeeting(ray, [&](std::uint32_t i) {
    const auto t = mSurface.points(i);
    const int turn = passThrough(p, 2, t);
    if (turn != 0 && sideOfPlane(p, t) != turn) number += turn;
  });
  return number;
}

}  // namespace pdc::detail
