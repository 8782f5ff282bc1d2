#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "io/parse/ply_header.h"
#include "io/parse/ply_numbers.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The faces of a binary .ply file, a block at a time, with the positions of their corners.
class PlyStream {
 public:
  /// Nothing where the file has to be read whole: see clusterFile(). \param header whose bytes outlive the result.
  [[nodiscard]] static std::optional<PlyStream> open(const PlyHeader& header);

  /// What the file says, and what was subtracted from positions so that single precision serves, as in readMesh().
  [[nodiscard]] const Vec3d& origin() const { return mOrigin; }
  [[nodiscard]] std::size_t faces() const { return mFaces.count; }
  [[nodiscard]] std::size_t facesRead() const { return mFacesRead; }
  /// How many bytes follow the next face.
  [[nodiscard]] std::size_t left() const { return mNumbers.left(); }
  /// How many bytes follow the last face, where nothing else should; to be asked behind it.
  [[nodiscard]] std::size_t unread() const { return mFacesAreLast ? mNumbers.left() : 0; }

  /// The next faces as triangles, corner by corner: see clusterFile(). \returns whether there were any. \throws Error
  /// for a face that names a vertex that does not exist or has less than three corners, and where the file ends early.
  bool next(std::vector<std::array<Vec3f, 3>>& triangles);

 private:
  PlyStream(const PlyHeader& header, std::string_view vertices, std::string_view faces);

  void chooseOrigin();
  [[nodiscard]] Vec3d coordinates(std::size_t vertex) const;
  [[nodiscard]] Vec3f position(std::size_t vertex) const;
  void readFace();
  void readCorners();
  void addFace();

  std::string_view mVertices;
  std::size_t mVertexBytes = 0, mVertexCount = 0;
  std::array<std::size_t, 3> mOffset{};  ///< Where x, y and z stand in a vertex.
  std::array<PlyType, 3> mType{};
  bool mSwap;
  bool mPlain = false;  ///< Whether x, y and z are single precision in the machine's byte order, side by side.
  bool mOwn;
  bool mFacesAreLast = false;
  Vec3d mShift{0, 0, 0}, mOrigin{0, 0, 0};

  PlyElement mFaces;
  std::size_t mIndices = 0;  ///< Which of the faces' properties names their vertices.
  BinaryNumbers mNumbers;
  std::size_t mFacesRead = 0;
  Buffer<Vec3f> mCorners;  ///< What the face that is being read has so far.
  Mesh mOthers;            ///< Faces of the block with more than three corners, each with vertices of its own.
  std::vector<std::array<Vec3f, 3>> mTriangles;
};

}  // namespace pdc::detail
