#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/parse/parsed_mesh.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Collects what a mesh file says, face by face. Errors name faces by their line or, without one, by their number in
/// the file, from 0, and vertices as the file does.
class SoupBuilder {
 public:
  /// \param shift see ParsedMesh. \param firstNumber the number of the first vertex in the file.
  explicit SoupBuilder(const Vec3d& shift, std::int64_t firstNumber = 0) : mShift(shift), mFirstNumber(firstNumber) {}

  void addVertex(const Vec3d& position) {
    mParsed.narrowing.include(position);
    mParsed.mesh.positions.push_back(vecCast<float>(position - mShift));
  }
  void addNormal(const Vec3d& normal) { mParsed.mesh.normals.push_back(vecCast<float>(normal)); }
  void setProperties(std::vector<VertexProperty> properties) { mParsed.mesh.properties = std::move(properties); }
  /// Three corners, from 0 on, make a triangle, four a quad, more a polygon. The vertices may be added later.
  /// \param line of the file; 0 if it is no text. \throws Error for fewer than three corners or an index that no mesh
  /// can have.
  void addFace(std::span<const std::int64_t> corners, std::size_t line = 0);
  void warn(std::string warning) { mParsed.warnings.push_back(std::move(warning)); }
  /// See ParsedMesh.
  void splitQuads(bool known) { mParsed.splitsQuads = known; }
  [[nodiscard]] std::size_t vertices() const { return mParsed.mesh.positions.size(); }
  [[nodiscard]] std::size_t normals() const { return mParsed.mesh.normals.size(); }
  [[nodiscard]] std::size_t faces() const { return mFaces; }
  void dropNormals() { mParsed.mesh.normals.clear(); }

  /// \param origin what the file says of it. \throws Error if a face names a vertex that was not added.
  [[nodiscard]] ParsedMesh finish(const std::optional<Vec3d>& origin);

 private:
  struct Corner {
    std::int64_t vertex = -1;
    std::size_t face = 0, line = 0;
  };

  /// What is wrong with a corner whose vertex does not exist.
  [[nodiscard]] Error missingVertex(const Corner& corner, const std::string& limit) const;

  ParsedMesh mParsed;
  Vec3d mShift;
  std::int64_t mFirstNumber;
  std::vector<std::uint32_t> mPolygon;  ///< Kept for its memory.
  std::size_t mFaces = 0;
  Corner mLargest;  ///< The first with the largest index.
};

}  // namespace pdc::detail
