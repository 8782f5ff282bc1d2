#pragma once

#include <vector>

#include "extract/fans.h"
#include "extract/quad_rings.h"
#include "mesh/triangle_pair.h"

namespace pdc::detail {

/// Two triangles that meet where they should not; or, twice the same, one that is degenerate or faces backwards.
struct Offence {
  EdgeRef edge0, edge1;  ///< Whose faces they belong to.
  Triangle triangle0, triangle1;
  friend auto operator<=>(const Offence&, const Offence&) = default;
};

/// What is asked of single faces, decided exactly on the mesh's coordinates.
class FaceTests {
 public:
  FaceTests(const LatticeMap& map, const QuadRings& rings, const Fans& fans, const Mesh& mesh)
      : mMap(map), mRings(rings), mFans(fans), mMesh(mesh) {}

  /// Whether the lattice edge passes through the planes of both of the quad's triangles, from behind to before.
  [[nodiscard]] bool passes(const EdgeRef& e, const Quad& quad) const;
  /// Whether the triangle has an area and looks the way the surface passes the lattice edge.
  [[nodiscard]] bool facesForward(const EdgeRef& e, const TriangleCorners& t) const;

  /// Tells which edges have faces that may leave the cells about them.
  void setFarReaching(const std::vector<EdgeRef>& edges) { mFar = EdgeSet(mRings.blockCount(), edges); }
  [[nodiscard]] const EdgeSet& farReaching() const { return mFar; }

  [[nodiscard]] TriangleCorners corners(const Triangle& t) const {
    return {mMesh.positions[t[0]], mMesh.positions[t[1]], mMesh.positions[t[2]]};
  }
  /// Replaces `out` by the triangles of the edge's quad or fan.
  void triangles(const EdgeRef& e, std::vector<Triangle>& out) const;
  [[nodiscard]] const QuadRings& rings() const { return mRings; }
  [[nodiscard]] const LatticeMap& map() const { return mMap; }

 private:
  const LatticeMap& mMap;
  const QuadRings& mRings;
  const Fans& mFans;
  const Mesh& mMesh;
  EdgeSet mFar;
};

/// Finds what a face meets. For one thread.
class NearFaces {
 public:
  explicit NearFaces(const FaceTests& tests) : mTests(tests) {}

  /// Appends the offences of the edge's triangles, against each other and against all others near them. Those between
  /// two of the `active` edges, which are sorted, are found from the first.
  void findOffences(const EdgeRef& e, const std::vector<EdgeRef>& active, std::vector<Offence>& out);

 private:
  struct Face {
    Triangle vertices;
    TriangleCorners corners;
  };
  [[nodiscard]] bool load(const EdgeRef& e, std::vector<Face>& faces);
  /// Box of the face's own triangles in lattice units.
  [[nodiscard]] std::pair<Vec3d, Vec3d> latticeBox(const EdgeRef& e) const;
  void test(const EdgeRef& e, const EdgeRef& other, std::vector<Offence>& out);

  const FaceTests& mTests;
  std::vector<Triangle> mTriangles;
  std::vector<Face> mOwn, mOther;
  Vec3f mLow{}, mHigh{};  ///< Box of the face's own triangles.
};

}  // namespace pdc::detail
