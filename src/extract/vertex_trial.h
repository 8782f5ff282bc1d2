#pragma once

#include <span>
#include <vector>

#include "extract/near_faces.h"
#include "extract/triangle_filters.h"

namespace pdc::detail {

/// What the faces of a vertex would meet if the vertex were elsewhere. For affine maps.
class VertexTrial {
 public:
  /// \param places all that will be asked for, in world space, its own among them.
  VertexTrial(const NearFaces& near, const FaceTests& tests, const LooseVertex& vertex, std::span<const Vec3f> places);

  /// Whether the tests of other faces would find those of the vertex there.
  [[nodiscard]] bool finds(const Vec3f& place) const;
  /// How many offences the faces of the vertex would have there; counts to `most`.
  [[nodiscard]] std::size_t countOffences(const Vec3f& place, std::size_t most);

 private:
  /// A quad, or one triangle of a fan: then the last corner is there twice.
  struct Piece {
    Piece(const EdgeRef& e, const Quad& v, const std::array<Vec3f, 4>& c)
        : edge(e), vertices(v), corners(c), count(v[2] == v[3] ? 1 : 2) {}
    [[nodiscard]] Triangle triangle(int i) const { return {vertices[0], vertices[i + 1], vertices[i + 2]}; }
    [[nodiscard]] TriangleCorners cornersOf(int i) const { return {corners[0], corners[i + 1], corners[i + 2]}; }
    [[nodiscard]] TrianglePlane planeOf(int i) const { return {triangle(i), cornersOf(i)}; }
    /// Moves one of the vertices.
    void move(std::uint32_t vertex, const Vec3f& place);

    EdgeRef edge;
    Quad vertices;
    std::array<Vec3f, 4> corners;
    int count;  ///< Of triangles.
    Box box{corners};
    std::array<TrianglePlane, 2> planes{planeOf(0), planeOf(1)};
  };
  /// One that has the vertex.
  struct OwnPiece : Piece {
    std::vector<std::uint32_t> near;  ///< Those of mFixed that it may reach; those met last first.
    std::size_t offences = 0;         ///< When last counted.
  };

  void addPiece(const Piece& piece, std::span<const Vec3f> places);
  [[nodiscard]] std::size_t countOffences(std::size_t own, std::size_t most);
  [[nodiscard]] static std::size_t countPairs(const Piece& own, const Piece& other, std::size_t most);

  const NearFaces& mNear;
  const FaceTests& mTests;
  std::uint32_t mVertex;
  std::vector<EdgeRef> mEdges;
  std::vector<OwnPiece> mOwn;
  std::vector<Piece> mFixed;
};

}  // namespace pdc::detail
