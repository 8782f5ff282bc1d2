#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Collects what a mesh file says, face by face. Errors name faces by their number in the file, from 0.
class SoupBuilder {
 public:
  void addVertex(const Vec3f& position) { mMesh.positions.push_back(position); }
  void addNormal(const Vec3f& normal) { mMesh.normals.push_back(normal); }
  void setProperties(std::vector<VertexProperty> properties) { mMesh.properties = std::move(properties); }
  /// Three corners make a triangle, four a quad, more a polygon. The vertices may be added later.
  /// \throws Error for fewer than three corners or an index that no mesh can have.
  void addFace(std::span<const std::int64_t> corners);
  [[nodiscard]] std::size_t vertices() const { return mMesh.positions.size(); }
  [[nodiscard]] std::size_t normals() const { return mMesh.normals.size(); }
  void dropNormals() { mMesh.normals.clear(); }

  /// \throws Error if a face names a vertex that was not added.
  [[nodiscard]] Mesh finish();

 private:
  Mesh mMesh;
  std::vector<std::uint32_t> mPolygon;  ///< Kept for its memory.
  std::size_t mFaces = 0;
  std::int64_t mLargestIndex = -1;
  std::size_t mFaceOfLargestIndex = 0;
};

}  // namespace pdc::detail
