#include "mesh/triangle_forest.h"

#include <utility>

namespace pdc::detail {

TriangleForest::TriangleForest(const Mesh& mesh, std::size_t size, Buffer<std::uint32_t> triangles)
    : mMesh(mesh), mTreeOf(size, kNone) {
  add(std::move(triangles));
}

void TriangleForest::add(Buffer<std::uint32_t> triangles) {
  if (triangles.empty()) return;
  while (!mTrees.empty() && mTrees.back().tree.triangles().size() <= 2 * triangles.size()) {
    for (const std::uint32_t t : mTrees.back().tree.triangles())
      if (mTreeOf[t] == mTrees.back().number) triangles.push_back(t);
    mTrees.pop_back();
  }
  for (const std::uint32_t t : triangles) mTreeOf[t] = mNext;
  mTrees.push_back({mNext++, TriangleTree(mMesh, std::move(triangles))});
}

}  // namespace pdc::detail
