#include "simplify/error_bound/tracked_error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "simplify/error_bound/star_gap.h"

namespace pdc::detail {

TrackedError::TrackedError(const DecimatedSurface& surface, const ErrorLimits& limits)
    : mSurface(surface), mDistance(limits.distance()), mErrors(surface.faces.size(), 0) {
  if (limits.uniform()) return;
  for (std::uint32_t f = 0; f < mErrors.size(); ++f) mLimits.push_back(limits.of(f));
}

/// How far the faces about the edge may be from those given, the least of all that they stand for.
double TrackedError::limitOf(const VertexStars& stars, const ChosenCollapse& collapse) const {
  if (mLimits.empty()) return mDistance;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : {collapse.a, collapse.b})
    for (const StarCorner& c : stars[v]) least = std::min(least, mLimits[c.face]);
  return least;
}

/// What the faces about the edge will have.
double TrackedError::errorOf(const VertexStars& stars, const ChosenCollapse& collapse, double limit) const {
  double before = 0;
  for (const std::uint32_t v : {collapse.a, collapse.b})
    for (const StarCorner& c : stars[v]) before = std::max(before, mErrors[c.face]);
  return before > limit ? before : before + starGap(mSurface, stars, collapse);
}

std::vector<ChosenCollapse> TrackedError::takeOutFar(const VertexStars& stars,
                                                     std::vector<ChosenCollapse>& collapses) const {
  std::vector<std::uint8_t> isNear(collapses.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, collapses.size(), 32), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) {
      const double limit = limitOf(stars, collapses[i]);
      isNear[i] = errorOf(stars, collapses[i], limit) <= limit;
    }
  });
  std::vector<ChosenCollapse> near, far;
  for (std::size_t i = 0; i < collapses.size(); ++i) (isNear[i] != 0 ? near : far).push_back(collapses[i]);
  collapses = std::move(near);
  return far;
}

void TrackedError::accept(const VertexStars& stars, const std::vector<ChosenCollapse>& collapses) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, collapses.size(), 32), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) {
      const double limit = limitOf(stars, collapses[i]), error = errorOf(stars, collapses[i], limit);
      for (const std::uint32_t v : {collapses[i].a, collapses[i].b})
        for (const StarCorner& c : stars[v]) {
          mErrors[c.face] = error;
          if (!mLimits.empty()) mLimits[c.face] = limit;
        }
    }
  });
}

}  // namespace pdc::detail
