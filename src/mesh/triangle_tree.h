#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/hubs.h"
#include "mesh/oriented_box.h"
#include "mesh/triangle_pair.h"
#include "pdc/math/box.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

[[nodiscard]] BoxF boxOf(const TriangleCorners& t);

/// A hierarchy of boxes over triangles of a mesh: leaves of a few triangles that are neighbours along a space-filling
/// curve, and above them boxes of kFan boxes each. Triangles of very different size are in different branches, so that
/// a huge one does not make the boxes of small ones huge. Slivers are in branches of their own, which have oriented
/// boxes too, and so are the triangles of each hub.
class TriangleTree {
 public:
  static constexpr std::size_t kLeaf = 4, kFan = 4;

  /// Sorts the triangles with these numbers (see faces.h), all of them finite. Runs in parallel; the tree depends only
  /// on the arguments.
  /// \param hubs the hub of each, or kNoHub; empty for no hubs. \param margin boxes reach so far beyond the triangles.
  explicit TriangleTree(const Mesh& mesh, Buffer<std::uint32_t> triangles, std::span<const std::uint32_t> hubs = {},
                        float margin = 0);

  /// Numbers of all triangles, as the leaves have them.
  [[nodiscard]] std::span<const std::uint32_t> triangles() const { return mTriangles; }
  [[nodiscard]] std::size_t leafCount() const { return mLevels.empty() ? 0 : mLevels.front().size(); }
  /// Numbers of the triangles of a leaf.
  [[nodiscard]] std::span<const std::uint32_t> leaf(std::size_t i) const { return part(mTriangles, i); }
  /// Their hubs; empty if there are none in the tree.
  [[nodiscard]] std::span<const std::uint32_t> leafHubs(std::size_t i) const {
    return mHubs.empty() ? std::span<const std::uint32_t>() : part(mHubs, i);
  }

  /// Calls visit(j) for this leaf and all later ones whose boxes meet its box, until visit returns false; but not where
  /// all triangles of both are at one hub. The order depends on the tree only.
  template <typename Visit>
  bool visitNeighbours(std::size_t i, Visit&& visit) const {
    return visitBelow(mLevels.size() - 1, 0, {i, mLevels.front()[i], sliverNode(0, i)}, visit);
  }

  /// Calls visit(triangle) for all triangles of leaves whose boxes meet a box. The order depends on the tree only.
  template <typename Visit>
  void visitMeeting(const BoxF& box, Visit&& visit) const {
    const auto visitLeaf = [&](std::size_t node) {
      for (const std::uint32_t t : leaf(node)) visit(t);
      return true;
    };
    if (!mLevels.empty()) visitBelow(mLevels.size() - 1, 0, {0, box, nullptr}, visitLeaf);
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
    std::array<std::pair<double, std::size_t>, kFan> order;  // Those near enough, by distance and then by number.
    std::size_t near = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double squared = mLevels[level - 1][first + i].squaredDistance(p);
      if (!(squared < reach)) continue;
      std::size_t place = near++;
      for (; place > 0 && order[place - 1].first > squared; --place) order[place] = order[place - 1];
      order[place] = {squared, first + i};
    }
    for (std::size_t i = 0; i < near && order[i].first < reach; ++i)
      visitNearestBelow(level - 1, order[i].second, p, reach, visit);
  }

  /// What a node in the branches of slivers and hubs has besides its box.
  struct SliverNode {
    OrientedBox box;
    std::uint32_t hub = kNoHub;  ///< The one hub of all its triangles.
  };
  /// The last nodes of a level: all those in the branches of slivers and hubs.
  struct SliverNodes {
    std::size_t first = 0;
    Buffer<SliverNode> nodes;
  };
  /// A leaf that looks for neighbours.
  struct Query {
    std::size_t leaf;
    const BoxF& box;
    const SliverNode* sliver;  ///< Null for a leaf without slivers.
  };

  [[nodiscard]] static std::span<const std::uint32_t> part(const Buffer<std::uint32_t>& all, std::size_t leaf) {
    return std::span(all).subspan(kLeaf * leaf, std::min(kLeaf, all.size() - kLeaf * leaf));
  }

  [[nodiscard]] const SliverNode* sliverNode(std::size_t level, std::size_t node) const {
    if (level >= mSlivers.size() || node < mSlivers[level].first) return nullptr;
    return &mSlivers[level].nodes[node - mSlivers[level].first];
  }

  [[nodiscard]] bool mayMeet(std::size_t level, std::size_t node, const Query& query) const {
    if (!mLevels[level][node].meets(query.box)) return false;
    const SliverNode* sliver = sliverNode(level, node);
    if (sliver == nullptr) return true;
    if (query.sliver == nullptr) return !sliver->box.apartFrom(OrientedBox(query.box));
    if (sliver->hub != kNoHub && sliver->hub == query.sliver->hub) return false;
    return !sliver->box.apartFrom(query.sliver->box);
  }

  template <typename Visit>
  bool visitBelow(std::size_t level, std::size_t node, const Query& query, Visit& visit) const {
    if (!mayMeet(level, node, query)) return true;
    if (level == 0) return visit(node);
    const std::size_t lo = std::max(kFan * node, query.leaf >> (kFanBits * (level - 1)));
    const std::size_t hi = std::min(kFan * (node + 1), mLevels[level - 1].size());
    for (std::size_t child = lo; child < hi; ++child)
      if (!visitBelow(level - 1, child, query, visit)) return false;
    return true;
  }

  void addSliverLeaves(const Mesh& mesh, std::size_t firstTriangle, float margin);
  void addSliverLevel();

  static constexpr std::size_t kFanBits = 2;
  static_assert(kFan == std::size_t{1} << kFanBits);

  Buffer<std::uint32_t> mTriangles, mHubs;
  std::vector<Buffer<BoxF>> mLevels;  ///< The leaves first, the one root last.
  std::vector<SliverNodes> mSlivers;  ///< For each level, as far up as it has any.
};

}  // namespace pdc::detail
