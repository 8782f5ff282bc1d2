#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "extract/quad_rings.h"

namespace pdc::detail {

/// Quads that are replaced by triangles about a new vertex where the surface crosses their lattice edge; and *split*
/// cells, whose vertices are joined to those of the cells beside them through a new vertex in the common face, on the
/// chord between the two crossings that the surface joins there.
class Fans {
 public:
  Fans(const HermiteSource& source, const SurfaceBlocks& blocks, const QuadRings& rings, Mesh& mesh);
  ~Fans();
  Fans(const Fans&) = delete;
  Fans& operator=(const Fans&) = delete;

  [[nodiscard]] bool has(const EdgeRef& e) const { return mCenter.contains(e); }
  [[nodiscard]] std::size_t size() const { return mCenter.size(); }

  /// Makes a fan of the edge's quad; appends its vertex to the mesh.
  void add(const EdgeRef& e);
  /// Splits the cell and makes fans of all quads at its edges, which it appends to `changed`. \returns false if it has
  /// been split before.
  bool split(const CellRef& c, std::vector<EdgeRef>& changed);

  /// Appends the triangles of a fan, wound like its quad.
  void triangles(const EdgeRef& e, std::vector<Triangle>& out) const;

  /// Puts the triangles of all fans in the place of their quads.
  void replaceQuads();

 private:
  struct Crossings;
  using Cell = std::pair<std::int32_t, int>;
  using Segment = std::pair<EdgeRef, EdgeRef>;

  static Cell key(const CellRef& c) { return {c.block, 64 * c.x + 8 * c.y + c.z}; }
  /// The two lattice edges that the surface joins in the face between ring cells k and k + 1 of an edge.
  [[nodiscard]] Segment segment(const EdgeRef& e, const CellRef& c, int k) const;
  [[nodiscard]] Vec3d crossing(const EdgeRef& e);
  std::uint32_t append(const Vec3d& position, const EdgeRef& at);

  const HermiteSource& mSource;
  const SurfaceBlocks& mBlocks;
  const QuadRings& mRings;
  Mesh& mMesh;
  std::map<EdgeRef, std::uint32_t> mCenter;
  std::set<Cell> mSplit;
  std::map<Segment, std::uint32_t> mFaceVertex;
  std::unique_ptr<Crossings> mCrossings;  ///< Of the block last asked for.
};

}  // namespace pdc::detail
