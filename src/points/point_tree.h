#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/math/box.h"

namespace pdc::detail {

/// Boxes about runs of points, eight under a larger one, and so on: finds the points within a radius. The radius may be
/// another each time and the points as uneven as they like; it is fast where points near each other come near each
/// other (see spatialOrder). The points must outlive it, and there is at least one.
class PointTree {
 public:
  explicit PointTree(std::span<const Vec3d> points);

  /// Calls visit(index, squared distance) for each point no farther from `centre` than `radius`, by ascending index.
  template <typename Visit>
  void visitWithin(const Vec3d& centre, double radius, const Visit& visit) const {
    visitNode(mLevels.size() - 1, 0, {centre, radius * radius}, visit);
  }

  /// The square of the distance to the k-th nearest point, k >= 1; infinite if there are fewer. A point of the tree at
  /// the centre is the first.
  [[nodiscard]] double squaredDistanceToNearest(const Vec3d& centre, std::size_t k) const;

 private:
  static constexpr std::size_t kFan = 8;

  struct Ball {
    Vec3d centre;
    double squaredRadius;
  };

  template <typename Visit>
  void visitNode(std::size_t level, std::size_t node, const Ball& ball, const Visit& visit) const {
    if (mLevels[level][node].squaredDistance(ball.centre) > ball.squaredRadius) return;
    const std::size_t begin = node * kFan;
    if (level == 0) {
      for (std::size_t i = begin; i < std::min(begin + kFan, mPoints.size()); ++i) {
        const Vec3d d = mPoints[i] - ball.centre;
        const double squared = dot(d, d);
        if (squared <= ball.squaredRadius) visit(static_cast<std::uint32_t>(i), squared);
      }
      return;
    }
    for (std::size_t i = begin; i < std::min(begin + kFan, mLevels[level - 1].size()); ++i)
      visitNode(level - 1, i, ball, visit);
  }
  void nearestInNode(std::size_t level, std::size_t node, const Vec3d& centre, std::span<double> nearest) const;

  std::span<const Vec3d> mPoints;
  std::vector<std::vector<Box>> mLevels;  ///< Boxes of points first, then of eight boxes each; the last level has one.
};

}  // namespace pdc::detail
