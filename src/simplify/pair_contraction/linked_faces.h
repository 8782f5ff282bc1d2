#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Triangles in which vertices become one. Edges may have any number of faces and vertices any number of fans: each
/// vertex has a list of its corners, in 12 bytes per face besides the faces and 4 per vertex.
class LinkedFaces {
 public:
  /// \param faces none of which names a vertex twice.
  LinkedFaces(std::span<const Triangle> faces, std::size_t vertices);

  /// How many there are.
  [[nodiscard]] std::size_t size() const { return mSize; }
  [[nodiscard]] const Triangle& operator[](std::uint32_t face) const { return mFaces[face]; }
  /// Fills the faces at a vertex.
  void findStar(std::uint32_t vertex, std::vector<StarCorner>& star);
  [[nodiscard]] bool hasFaces(std::uint32_t vertex) const;
  /// Calls visit(face) for all faces that two vertices have in common; it takes as long as the smaller star is large.
  template <typename Visit>
  void forEachCommon(std::uint32_t a, std::uint32_t b, const Visit& visit) const {
    std::uint32_t atA = mFirst[a], atB = mFirst[b];
    while (atA != kNone && atB != kNone) {
      atA = mNext[atA];
      atB = mNext[atB];
    }
    const std::uint32_t other = atA == kNone ? b : a;
    for (std::uint32_t c = mFirst[atA == kNone ? a : b]; c != kNone; c = mNext[c]) {
      const Triangle& t = mFaces[c / 3];
      if (!isRemoved(c / 3) && (t[0] == other || t[1] == other || t[2] == other)) visit(c / 3);
    }
  }

  /// \pre it is not removed.
  void remove(std::uint32_t face);
  /// Removed faces stay in the lists until these are next walked.
  [[nodiscard]] bool isRemoved(std::uint32_t face) const { return mFaces[face][0] == mFaces[face][1]; }
  /// Gives a the faces of b. \pre they have none in common.
  void merge(std::uint32_t a, std::uint32_t b);
  /// The faces that are left, in the order in which they were given.
  [[nodiscard]] Buffer<Triangle> left() const;

 private:
  static constexpr auto kNone = static_cast<std::uint32_t>(-1);

  std::vector<Triangle> mFaces;
  std::vector<std::uint32_t> mFirst;  ///< By vertex, its first corner: three times the face, and which of it.
  std::vector<std::uint32_t> mNext;   ///< By corner, the next one of its vertex.
  std::size_t mSize;
};

/// Takes out all but the first of the triangles that have the same vertices, in any order. \returns how many.
std::size_t removeDuplicates(Buffer<Triangle>& faces);

}  // namespace pdc::detail
