#include "simplify/pair_contraction/star_checks.h"

namespace pdc::detail {

bool ManifoldStars::isManifold(std::span<const StarCorner> star) {
  if (star.empty()) return true;
  mNext.clear();
  mPrevious.clear();
  for (std::uint32_t i = 0; i < star.size(); ++i) {
    if (mNext.has(star[i].next) || mPrevious.has(star[i].previous)) return false;
    mNext.set(star[i].next, i);
    mPrevious.set(star[i].previous, i);
  }
  std::size_t first = 0, begins = 0;
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (mPrevious.has(star[i].next)) continue;
    first = i;
    ++begins;
  }
  if (begins > 1) return false;
  // Closed fans come back to where they began; one of several does so before all faces are met.
  std::size_t met = 1;
  for (std::size_t i = first; mNext.has(star[i].previous); ++met) {
    i = mNext[star[i].previous];
    if (i == first) break;
  }
  return met == star.size();
}

bool ManifoldStars::keepsTopology(std::span<const StarCorner> starA, std::span<const StarCorner> starB, std::uint32_t a,
                                  std::uint32_t b) {
  VertexMarks& isNeighbour = mNext;
  isNeighbour.clear();
  std::size_t faces = 0, common = 0;
  for (const StarCorner& c : starA) {
    faces += c.next == b || c.previous == b;
    isNeighbour.set(c.next, 1);
    isNeighbour.set(c.previous, 1);
  }
  for (const StarCorner& c : starB)
    for (const std::uint32_t v : {c.next, c.previous}) {
      if (v == a || !isNeighbour.has(v)) continue;
      common += isNeighbour[v];
      isNeighbour.set(v, 0);
    }
  if (common != faces) return false;
  const bool boundaryA = atBoundary(starA), boundaryB = atBoundary(starB);
  // An edge across the surface from boundary to boundary would pinch it.
  if (boundaryA && boundaryB && faces != 1) return false;
  // What is left around the vertex: three faces at least, or one at a boundary.
  const std::size_t left = starA.size() + starB.size() - 2 * faces;
  return left >= (boundaryA || boundaryB ? 1 : 3);
}

bool keepsFaces(std::span<const StarCorner> star, const std::vector<Vec3d>& positions, const Vec3d& from,
                const Vec3d& place, std::uint32_t other, double leastCosine) {
  for (const StarCorner& c : star) {
    if (c.next == other || c.previous == other) continue;
    const Vec3d &next = positions[c.next], &previous = positions[c.previous];
    const Vec3d before = cross(next - from, previous - from), n = cross(next - place, previous - place);
    if (!(dot(before, before) > 0)) continue;  // It has no side to turn away from.
    const double along = dot(n, before), sizes = dot(n, n) * dot(before, before);
    if (!(along > 0) || !(along * along > leastCosine * leastCosine * sizes)) return false;
  }
  return true;
}

}  // namespace pdc::detail
