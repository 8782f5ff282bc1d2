#pragma once

#include <utility>
#include <vector>

#include "extract/conflicts/fans.h"
#include "extract/conflicts/vertex_state.h"
#include "extract/topology/edge_cells.h"
#include "mesh/triangle_pair.h"

namespace pdc::detail {

/// Tests of single faces, decided exactly on the mesh's coordinates.
class FaceTests {
 public:
  FaceTests(const LatticeMap& map, const EdgeCells& edgeCells, const Fans& fans, SuspectIndex suspectIndex,
            const std::vector<VertexState>& suspects, const Mesh& mesh)
      : mMap(map),
        mEdgeCells(edgeCells),
        mFans(fans),
        mSuspectIndex(std::move(suspectIndex)),
        mSuspects(suspects),
        mMesh(mesh) {}

  /// Whether the lattice edge passes through the planes of both of the quad's triangles, from their backs to their
  /// fronts.
  [[nodiscard]] bool passes(const EdgeRef& e, const Quad& quad) const;
  /// Whether the triangle has an area and looks the way the surface passes the lattice edge; or, where a corner lies on
  /// a crease, the way one of the planes looks that meet there: beside a sharp crease a triangle of one side may stand
  /// for a lattice edge that passes the other.
  [[nodiscard]] bool facesForward(const EdgeRef& e, const Triangle& vertices, const TriangleCorners& t) const {
    return facesForward(forward(e), vertices, t);
  }

  [[nodiscard]] bool facesForward(const Vec3d& forward, const Triangle& vertices, const TriangleCorners& t) const;
  /// The way, in world space, in which the surface passes the lattice edge: from inside to outside.
  [[nodiscard]] Vec3d forward(const EdgeRef& e) const;

  [[nodiscard]] const Vec3f& position(std::uint32_t vertex) const { return mMesh.positions[vertex]; }
  template <std::size_t n>
  [[nodiscard]] std::array<Vec3f, n> corners(const std::array<std::uint32_t, n>& vertices) const {
    std::array<Vec3f, n> p;
    for (std::size_t i = 0; i < n; ++i) p[i] = mMesh.positions[vertices[i]];
    return p;
  }
  /// \param place in lattice units from the centre of the vertex's cell.
  [[nodiscard]] Vec3f worldPosition(const SuspectVertex& v, const Vec3f& place) const;
  /// The place of a vertex of the mesh among the suspect ones, or -1.
  [[nodiscard]] std::ptrdiff_t suspectNumber(std::uint32_t vertex) const { return mSuspectIndex.find(vertex); }
  /// The suspect vertex of that number, or null.
  [[nodiscard]] const VertexState* suspect(std::uint32_t vertex) const {
    const std::ptrdiff_t i = mSuspectIndex.find(vertex);
    return i < 0 ? nullptr : &mSuspects[static_cast<std::size_t>(i)];
  }
  /// The quad that a face is, or null if it is a fan.
  [[nodiscard]] const Quad* quad(std::uint64_t face) const { return mFans.has(face) ? nullptr : &mMesh.quads[face]; }
  /// Replaces `out` by the triangles of face number `face`, the quad or fan of the edge.
  void triangles(const EdgeRef& e, std::uint64_t face, std::vector<Triangle>& out) const;

  [[nodiscard]] const EdgeCells& edgeCells() const { return mEdgeCells; }
  [[nodiscard]] const LatticeMap& map() const { return mMap; }

 private:
  const LatticeMap& mMap;
  const EdgeCells& mEdgeCells;
  const Fans& mFans;
  SuspectIndex mSuspectIndex;
  const std::vector<VertexState>& mSuspects;
  const Mesh& mMesh;
};

}  // namespace pdc::detail
