#include "simplify/decimation/collapse_checks.h"

#include <cstddef>

namespace pdc::detail {
namespace {

bool isNeighbour(std::span<const StarCorner> star, std::uint32_t vertex) {
  for (const StarCorner& c : star)
    if (c.next == vertex || c.previous == vertex) return true;
  return false;
}

/// How many vertices that share an edge with a manifold star's share one with another's, too.
/// \param b that other, which is not counted itself.
std::size_t commonNeighbours(std::span<const StarCorner> starA, std::span<const StarCorner> starB, std::uint32_t b) {
  const auto counts = [&](std::uint32_t v) { return v != b && isNeighbour(starB, v); };
  std::size_t common = 0;
  for (const StarCorner& c : starA) {
    common += counts(c.next);
    // Few are counted, so that hubs need not look for the rest among their own.
    if (!counts(c.previous)) continue;
    bool isNext = false;
    for (const StarCorner& other : starA) isNext = isNext || other.next == c.previous;
    common += !isNext;
  }
  return common;
}

}  // namespace

bool CollapseChecks::keepsTopology(std::uint32_t a, std::uint32_t b) const {
  const std::span<const StarCorner> starA = mStars[a], starB = mStars[b];
  std::size_t faces = 0;
  for (const StarCorner& c : starA) faces += c.next == b || c.previous == b;
  if (commonNeighbours(starA, starB, b) != faces) return false;
  const bool ends = atBoundary(starA) && atBoundary(starB);
  // An edge across the surface from boundary to boundary would pinch it.
  if (ends && faces != 1) return false;
  // What is left around the vertex: three faces at least, or one at a boundary.
  const std::size_t left = starA.size() + starB.size() - 2 * faces;
  return left >= (ends || atBoundary(starA) || atBoundary(starB) ? 1 : 3);
}

bool CollapseChecks::keepsFacesOf(std::uint32_t moved, std::uint32_t other, const Vec3d& place) const {
  for (const StarCorner& c : mStars[moved]) {
    if (c.next == other || c.previous == other) continue;
    const Vec3d n = cross(mPositions[c.next] - place, mPositions[c.previous] - place);
    const Vec3d& before = mAreas[c.face].vector;
    if (!(dot(before, before) > 0)) continue;  // It has no side to turn away from.
    const double along = dot(n, before), sizes = dot(n, n) * dot(before, before);
    if (!(along > 0) || !(along * along > mLeastCosine * mLeastCosine * sizes)) return false;
  }
  return true;
}

}  // namespace pdc::detail
