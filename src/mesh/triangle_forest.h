#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/triangle_tree.h"

namespace pdc::detail {

/// Trees over triangles that change, some at a time: those changed last are in small trees, which are merged as they
/// become many (the logarithmic method of Bentley & Saxe 1980). Several threads may ask at a time.
class TriangleForest {
 public:
  /// \param mesh its triangles have numbers below `size`; it has to live as long. \param triangles finite ones.
  /// Runs in parallel.
  TriangleForest(const Mesh& mesh, std::size_t size, Buffer<std::uint32_t> triangles);

  /// A triangle that has changed or is gone is not found any more.
  void remove(std::uint32_t triangle) { mTreeOf[triangle] = kNone; }
  /// Adds triangles as the mesh has them now; they are finite and none is in the forest. Runs in parallel.
  void add(Buffer<std::uint32_t> triangles);

  /// Calls visit(triangle) for all triangles whose leaves meet a box.
  template <typename Visit>
  void visitMeeting(const BoxF& box, Visit&& visit) const {
    for (const Tree& tree : mTrees)
      tree.tree.visitMeeting(box, [&](std::uint32_t t) {
        if (mTreeOf[t] == tree.number) visit(t);
      });
  }

 private:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);

  struct Tree {
    std::uint32_t number;
    TriangleTree tree;
  };

  const Mesh& mMesh;
  std::vector<std::uint32_t> mTreeOf;  ///< By triangle, the number of the tree that has it.
  std::vector<Tree> mTrees;            ///< Each has more than twice as many triangles as the next one.
  std::uint32_t mNext = 0;             ///< No tree has had this number.
};

}  // namespace pdc::detail
