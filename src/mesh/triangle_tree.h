#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/triangle_pair.h"
#include "pdc/math/box.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

[[nodiscard]] BoxF boxOf(const TriangleCorners& t);

/// A hierarchy of boxes over triangles of a mesh: leaves of a few triangles that are neighbours along a space-filling
/// curve, and above them boxes of kFan boxes each. Triangles of very different size are in different branches, so that
/// a huge one does not make the boxes of small ones huge.
class TriangleTree {
 public:
  static constexpr std::size_t kLeaf = 4, kFan = 4;

  /// Sorts the triangles with these numbers (see faces.h), all of them finite. Runs in parallel; the tree depends only
  /// on the mesh and the numbers.
  TriangleTree(const Mesh& mesh, Buffer<std::uint32_t> triangles);

  [[nodiscard]] std::size_t leafCount() const { return mLevels.empty() ? 0 : mLevels.front().size(); }
  /// Numbers of the triangles of a leaf.
  [[nodiscard]] std::span<const std::uint32_t> leaf(std::size_t i) const {
    return std::span(mTriangles).subspan(kLeaf * i, std::min(kLeaf, mTriangles.size() - kLeaf * i));
  }

  /// Calls visit(j) for this leaf and all later ones whose boxes meet its box, until visit returns false. The order
  /// depends on the tree only.
  template <typename Visit>
  bool visitNeighbours(std::size_t i, Visit&& visit) const {
    return visitBelow(mLevels.size() - 1, 0, i, mLevels.front()[i], visit);
  }

  /// Calls visit(triangle) for all triangles that may be nearer to p than the square root of `reach`, which the visitor
  /// may lower on the way; those of near boxes first.
  template <typename Visit>
  void visitNearest(const Vec3d& p, const double& reach, Visit&& visit) const {
    if (!mLevels.empty()) visitNearestBelow(mLevels.size() - 1, 0, p, reach, visit);
  }

 private:
  template <typename Visit>
  void visitNearestBelow(std::size_t level, std::size_t node, const Vec3d& p, const double& reach, Visit& visit) const {
    if (level == 0) {
      for (const std::uint32_t t : leaf(node)) visit(t);
      return;
    }
    const std::size_t first = kFan * node, count = std::min(kFan, mLevels[level - 1].size() - first);
    std::array<std::pair<double, std::size_t>, kFan> order;
    for (std::size_t i = 0; i < count; ++i) order[i] = {mLevels[level - 1][first + i].squaredDistance(p), first + i};
    std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count && order[i].first < reach; ++i)
      visitNearestBelow(level - 1, order[i].second, p, reach, visit);
  }

  template <typename Visit>
  bool visitBelow(std::size_t level, std::size_t node, std::size_t first, const BoxF& box, Visit& visit) const {
    if (!mLevels[level][node].meets(box)) return true;
    if (level == 0) return visit(node);
    const std::size_t lo = std::max(kFan * node, first >> (kFanBits * (level - 1)));
    const std::size_t hi = std::min(kFan * (node + 1), mLevels[level - 1].size());
    for (std::size_t child = lo; child < hi; ++child)
      if (!visitBelow(level - 1, child, first, box, visit)) return false;
    return true;
  }

  static constexpr std::size_t kFanBits = 2;
  static_assert(kFan == std::size_t{1} << kFanBits);

  Buffer<std::uint32_t> mTriangles;
  std::vector<Buffer<BoxF>> mLevels;  ///< The leaves first, the one root last.
};

}  // namespace pdc::detail
