#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "extract/conflicts/face_boxes.h"
#include "extract/conflicts/float4_box.h"
#include "extract/conflicts/triangle_filters.h"

namespace pdc::detail {

/// Counts what the faces of a vertex would meet if the vertex were elsewhere. For affine maps.
class VertexTrial {
 public:
  /// \param boxes prepared for the vertex's block. \param places in world space, the vertex's own among them; must
  /// outlive this.
  VertexTrial(const FaceBoxes& boxes, const FaceTests& faces, const SuspectVertex& vertex,
              std::span<const Vec3f> places);

  /// How many conflicts the faces of the vertex would have at one of the places; counts to `most`. A face with a
  /// triangle that faces backwards counts as one; what else that triangle meets counts or not, by the order of faces,
  /// which earlier counts change.
  [[nodiscard]] std::size_t countConflicts(std::size_t place, std::size_t most);

 private:
  /// A fixed triangle that one of the vertex may meet.
  struct NearTriangle {
    std::uint32_t number;                 ///< In mFixed.
    std::array<std::uint8_t, 3> ownMask;  ///< All bits for the own triangle's corners that it does not have.
  };
  /// A triangle of a face of the vertex.
  struct OwnTriangle : FilteredTriangle {
    int moving;                          ///< Which corner is the vertex; -1: none, so that its counts stay the same.
    std::array<std::uint32_t, 3> point;  ///< Columns of mSides that the corners have.
    std::size_t firstNear, endNear;      ///< The range in mNear; those met last come first.
    std::optional<bool> forward;
    std::optional<std::size_t> nearCount;
  };
  /// A quad, or one triangle of a fan.
  struct OwnPiece {
    Vec3d forward;              ///< The way the surface passes its edge.
    std::size_t first, count;   ///< The range of its triangles in mOwn.
    std::size_t conflicts = 0;  ///< How many it had when last counted.
  };
  void addFaces(std::int32_t block, const Float4Box& box);
  void addOwn(const EdgeRef& e, std::span<const Triangle> triangles);
  void computeSides();
  void addNear(OwnTriangle& own, const Float4Box& places);
  void move(const OwnPiece& piece, std::size_t place);
  [[nodiscard]] bool facesForward(const OwnPiece& piece, OwnTriangle& own) const;
  [[nodiscard]] std::size_t countPiece(std::size_t i, std::size_t most);
  [[nodiscard]] std::size_t countNear(OwnTriangle& own, std::size_t most);
  [[nodiscard]] bool meets(const OwnTriangle& own, const NearTriangle& near) const;
  [[nodiscard]] std::span<OwnTriangle> triangles(const OwnPiece& piece) { return {&mOwn[piece.first], piece.count}; }

  const FaceBoxes& mBoxes;
  const FaceTests& mFaces;
  std::span<const Vec3f> mPlaces;
  std::uint32_t mVertex;
  std::vector<OwnTriangle> mOwn;
  std::vector<OwnPiece> mPieces;
  std::vector<std::size_t> mOrder;  ///< The order in which pieces are counted.
  std::vector<std::uint32_t> mRim;  ///< The other vertices of mOwn.
  std::vector<FilteredTriangle> mFixed;
  std::vector<NearTriangle> mNear;
  /// By triangle of mFixed, where the places and then the rim's vertices are to its plane.
  std::vector<Sides> mSides;
  std::size_t mColumns = 0;      ///< Columns of mSides; each triangle has a row.
  std::vector<Sides> mOfPlaces;  ///< By triangle of mFixed, the sides of all places together.
};

}  // namespace pdc::detail
