#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_pair.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

struct BoxF {
  Vec3f lo, hi;

  void include(const BoxF& o) {
    lo = {std::min(lo.x, o.lo.x), std::min(lo.y, o.lo.y), std::min(lo.z, o.lo.z)};
    hi = {std::max(hi.x, o.hi.x), std::max(hi.y, o.hi.y), std::max(hi.z, o.hi.z)};
  }
  /// Boxes include their borders.
  [[nodiscard]] bool meets(const BoxF& o) const {
    return lo.x <= o.hi.x && o.lo.x <= hi.x && lo.y <= o.hi.y && o.lo.y <= hi.y && lo.z <= o.hi.z && o.lo.z <= hi.z;
  }
};

[[nodiscard]] BoxF boxOf(const TriangleCorners& t);

/// A hierarchy of boxes over triangles of a mesh: leaves of a few triangles that are neighbours along a space-filling
/// curve, and above them boxes of kFan boxes each. Triangles of very different size are in different branches, so that
/// a huge one does not make the boxes of small ones huge.
class TriangleTree {
 public:
  static constexpr std::size_t kLeaf = 4, kFan = 4;

  /// Over the triangles with these numbers (see faces.h), all of them finite. Runs in parallel; the tree depends only
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

 private:
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
