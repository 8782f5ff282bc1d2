#include "simplify/edge_collapse.h"

#include <algorithm>

#include "pdc/math/solvers.h"
#include "simplify/edge_quadrics.h"

namespace pdc::detail {
namespace {

/// Eigenvalues of classical quadrics below this share of the largest count as zero. Lindstrom (2000) takes 1e-3, which
/// loses corners where one of the planes has a sliver only.
constexpr double kRankCutoff = 1e-6;

EdgeMinimum minimizeClassical(const VertexQuadric& a, const VertexQuadric& b, const Vec3d& half, const Vec3d& between) {
  const Quadric<double> error = sumAboutMiddle(a.q, b.q, half), wanted = error + volumePlane(a, b, half, between);
  const Vec3d place = minimizeNear(wanted, Vec3d{}, kRankCutoff);
  return {place, error(place), dot(place, place) <= 4 * kMostMove * kMostMove * dot(half, half)};
}

}  // namespace

EdgeCollapse CollapseRule::collapse(std::uint32_t a, std::uint32_t b, const Vec3d& between, bool keepsVolume) const {
  VertexQuadric qa = mQuadrics[a], qb = mQuadrics[b];
  if (!keepsVolume) qa.vectorArea = qb.vectorArea = between * 0.5;
  const Vec3d half = (mPositions[b] - mPositions[a]) * 0.5, middle = mPositions[a] + half;
  const auto errorAt = [&](const Vec3d& x) { return std::max(0.0, sumAboutMiddle(qa.q, qb.q, half)(x)); };
  if (mLocked[a] != 0 || mLocked[b] != 0 || subset) {
    const bool atA = mLocked[a] != 0 || (mLocked[b] == 0 && errorAt(-half) <= errorAt(half));
    return {mPositions[atA ? a : b], errorAt(atA ? -half : half), false};
  }
  EdgeMinimum m = classical ? minimizeClassical(qa, qb, half, between) : minimizeOnEdge(qa, qb, half, between);
  if (!m.found) {
    const Quadric<double> wanted = sumAboutMiddle(qa.q, qb.q, half) + volumePlane(qa, qb, half, between);
    m.place = Vec3d{};
    for (const Vec3d& end : {-half, half})
      if (wanted(end) < wanted(m.place)) m.place = end;
    m.cost = errorAt(m.place);
  }
  return {middle + m.place, std::max(0.0, m.cost), !m.found};
}

}  // namespace pdc::detail
