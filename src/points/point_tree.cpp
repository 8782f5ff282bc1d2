#include "points/point_tree.h"

#include <array>
#include <limits>
#include <utility>

#include "parallel/for_each_in_parallel.h"

namespace pdc::detail {
namespace {

/// Puts a distance in its place among the k least, which ascend.
void insert(std::span<double> nearest, double distance) {
  std::size_t at = nearest.size() - 1;
  for (; at > 0 && nearest[at - 1] > distance; --at) nearest[at] = nearest[at - 1];
  nearest[at] = distance;
}

}  // namespace

PointTree::PointTree(std::span<const Vec3d> points) : mPoints(points) {
  const auto ceilDivide = [](std::size_t n) { return (n + kFan - 1) / kFan; };
  std::vector<Box> boxes(ceilDivide(points.size()), Box::empty());
  forEachInParallel(boxes.size(), 512, [&](std::uint32_t b) {
    for (std::size_t i = b * kFan; i < std::min((b + 1) * kFan, points.size()); ++i) boxes[b].include(points[i]);
  });
  mLevels.push_back(std::move(boxes));
  while (mLevels.back().size() > 1) {
    const std::vector<Box>& below = mLevels.back();
    std::vector<Box> above(ceilDivide(below.size()), Box::empty());
    for (std::size_t i = 0; i < below.size(); ++i) above[i / kFan].include(below[i]);
    mLevels.push_back(std::move(above));
  }
}

double PointTree::squaredDistanceToNearest(const Vec3d& centre, std::size_t k) const {
  std::vector<double> nearest(k, std::numeric_limits<double>::infinity());
  nearestInNode(mLevels.size() - 1, 0, centre, nearest);
  return nearest.back();
}

void PointTree::nearestInNode(std::size_t level, std::size_t node, const Vec3d& centre,
                              std::span<double> nearest) const {
  const std::size_t begin = node * kFan;
  if (level == 0) {
    for (std::size_t i = begin; i < std::min(begin + kFan, mPoints.size()); ++i) {
      const Vec3d d = mPoints[i] - centre;
      if (dot(d, d) < nearest.back()) insert(nearest, dot(d, d));
    }
    return;
  }
  std::array<std::pair<double, std::size_t>, kFan> children;
  std::size_t count = 0;
  for (std::size_t i = begin; i < std::min(begin + kFan, mLevels[level - 1].size()); ++i)
    children[count++] = {mLevels[level - 1][i].squaredDistance(centre), i};
  std::sort(children.begin(), children.begin() + count);
  for (std::size_t c = 0; c < count && children[c].first < nearest.back(); ++c)
    nearestInNode(level - 1, children[c].second, centre, nearest);
}

}  // namespace pdc::detail
