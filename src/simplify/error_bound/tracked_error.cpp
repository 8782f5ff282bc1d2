#include "simplify/error_bound/tracked_error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "simplify/error_bound/star_gap.h"

namespace pdc::detail {

/// What the faces about the edge will have.
double TrackedError::errorOf(const VertexStars& stars, const ChosenCollapse& collapse) const {
  double before = 0;
  for (const std::uint32_t v : {collapse.a, collapse.b})
    for (const StarCorner& c : stars[v]) before = std::max(before, mErrors[c.face]);
  return before > mDistance ? before : before + starGap(mSurface, stars, collapse);
}

std::vector<ChosenCollapse> TrackedError::takeOutFar(const VertexStars& stars,
                                                     std::vector<ChosenCollapse>& collapses) const {
  std::vector<double> errors(collapses.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, collapses.size(), 32), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) errors[i] = errorOf(stars, collapses[i]);
  });
  std::vector<ChosenCollapse> near, far;
  for (std::size_t i = 0; i < collapses.size(); ++i) (errors[i] <= mDistance ? near : far).push_back(collapses[i]);
  collapses = std::move(near);
  return far;
}

void TrackedError::accept(const VertexStars& stars, const std::vector<ChosenCollapse>& collapses) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, collapses.size(), 32), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) {
      const double error = errorOf(stars, collapses[i]);
      for (const std::uint32_t v : {collapses[i].a, collapses[i].b})
        for (const StarCorner& c : stars[v]) mErrors[c.face] = error;
    }
  });
}

}  // namespace pdc::detail
