#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "extract/topology/edge_cells.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// What a fan has in a mesh.
struct FanPart {
  std::int32_t block;       ///< That of its lattice edge.
  std::uint32_t triangles;  ///< One after the other.
  std::uint32_t vertices;   ///< That no fan before it has, numbered one after the other.
};

/// Quads that are replaced by triangles about a new vertex where the surface crosses their lattice edge; and *split*
/// cells, whose vertices are joined to those of the cells beside them through a new vertex in the common face, on the
/// chord between the two crossings that the surface joins there.
class Fans {
 public:
  Fans(const HermiteSource& source, const SurfaceBlocks& blocks, const EdgeCells& edgeCells, Mesh& mesh);
  ~Fans();
  Fans(const Fans&) = delete;
  Fans& operator=(const Fans&) = delete;

  /// \param face number of an edge's quad.
  [[nodiscard]] bool has(std::uint64_t face) const { return (mIsFan[face / 64] >> face % 64 & 1) != 0; }
  [[nodiscard]] std::size_t size() const { return mCenter.size(); }

  /// Makes a fan of the edge's quad; appends its vertex to the mesh. \throws Error if the mesh has 2^32 vertices.
  void add(const EdgeRef& e);
  /// Splits the cell and makes fans of all quads at its edges, which it appends to `changed`. \returns false if it has
  /// been split before. \throws Error if the mesh would get more than 2^32 vertices.
  bool split(const CellRef& c, std::vector<EdgeRef>& changed);

  /// Appends the triangles of a fan, wound like its quad.
  void triangles(const EdgeRef& e, std::vector<Triangle>& out) const;

  /// Takes out the quads that are fans, and appends the triangles of these by ascending edge. The new vertices get
  /// numbers in that order, so that a mesh does not depend on the order in which fans were made, and all arrays are in
  /// the order of blocks: the old vertices, the new ones, the quads and the triangles. \returns by how many edges that
  /// lengthens the boundary of the mesh. \param parts null, or where to note what each fan has, in their order.
  /// \throws Cancelled.
  std::size_t replaceQuads(const Monitor& monitor, std::vector<FanPart>* parts = nullptr);

  /// The number of a vertex appended to so many. \throws Error if 32 bits cannot hold it.
  [[nodiscard]] static std::uint32_t numberAfter(std::uint64_t vertices);

 private:
  struct Crossings;
  using Cell = std::pair<std::int32_t, int>;
  /// Two of a cell's lattice edges that the surface joins in a face, each as its low end and its axis.
  using LatticeEdge = std::pair<Coord, int>;
  using Segment = std::pair<LatticeEdge, LatticeEdge>;
  /// A segment as numbers of edges of one of its cells.
  struct CellSegment {
    int edge0, edge1;
  };

  static Cell key(const CellRef& c) { return {c.block, 64 * c.x + 8 * c.y + c.z}; }
  [[nodiscard]] bool splitBetween(const CellRef& a, const CellRef& b) const {
    return mSplit.contains(key(a)) || mSplit.contains(key(b));
  }
  /// The segment through which an edge's quad goes on from cell k about it, which is `c`, to the next.
  [[nodiscard]] CellSegment segment(const EdgeRef& e, const CellRef& c, int k) const;
  [[nodiscard]] Segment segmentKey(const CellRef& c, const CellSegment& s) const;
  /// Where the surface crosses an edge of a cell, in lattice space.
  [[nodiscard]] Vec3d crossing(const CellRef& c, int edge);
  std::uint32_t append(const Vec3d& position, const EdgeRef& at);
  void renumber();
  /// \param parts with the numbers of triangles.
  void countVertices(std::vector<FanPart>& parts) const;
  void removeQuads(const std::vector<std::uint64_t>& faces);
  [[nodiscard]] std::size_t countPartedEdges(const Monitor& monitor) const;

  const HermiteSource& mSource;
  const SurfaceBlocks& mBlocks;
  const EdgeCells& mEdgeCells;
  Mesh& mMesh;
  const std::uint32_t mFirstVertex;   ///< The number of the first new vertex.
  std::vector<std::uint64_t> mIsFan;  ///< A bit per face.
  std::map<EdgeRef, std::uint32_t> mCenter;
  std::set<Cell> mSplit;
  std::map<Segment, std::uint32_t> mFaceVertex;
  std::unique_ptr<Crossings> mCrossings;  ///< Those of the block last asked for.
};

}  // namespace pdc::detail
