#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "extract/conflicts/face_tests.h"
#include "extract/conflicts/fans.h"
#include "extract/conflicts/vertex_state.h"
#include "extract/topology/edge_cells.h"
#include "extract/topology/surface.h"
#include "pdc/monitor.h"

namespace pdc::detail {

/// A mesh while it is certified: with the states of its suspect vertices, which its remedies number as the list has
/// them, and its fans.
class WorkingMesh {
 public:
  /// \param suspects by ascending vertex. \param mesh in quads only; must outlive this, as `monitor` must.
  WorkingMesh(const Surface& surface, const std::vector<SuspectVertex>& suspects, Mesh& mesh, const Monitor& monitor);
  WorkingMesh(const WorkingMesh&) = delete;
  WorkingMesh& operator=(const WorkingMesh&) = delete;

  /// Where those who work on the mesh notice that they should stop.
  [[nodiscard]] const Monitor& monitor() const { return mMonitor; }
  [[nodiscard]] const EdgeCells& edgeCells() const { return mEdgeCells; }
  [[nodiscard]] const FaceTests& faces() const { return mFaces; }
  [[nodiscard]] Fans& fans() { return mFans; }
  [[nodiscard]] const Fans& fans() const { return mFans; }
  [[nodiscard]] const Mesh& mesh() const { return mMesh; }
  [[nodiscard]] std::vector<VertexState>& vertices() { return mVertices; }
  [[nodiscard]] const std::vector<VertexState>& vertices() const { return mVertices; }
  /// Numbers of the suspect vertices on creases that are known.
  [[nodiscard]] const std::vector<std::size_t>& onCreases() const { return mOnCreases; }

  /// Number among the suspect vertices of one that may still be moved, or -1.
  [[nodiscard]] std::ptrdiff_t movable(std::uint32_t vertex) const;
  /// Whether a suspect vertex has been retracted to its safe place, from which nothing moves it.
  [[nodiscard]] static bool fullyRetracted(const VertexState& v);
  /// Moves suspect vertex i. \param place in lattice units from the centre of its cell.
  void moveTo(std::size_t i, const Vec3f& place);
  /// Retracts suspect vertex i towards its safe place, by some steps or as far as it goes. It must be movable.
  void retract(std::size_t i, int steps = 1);
  /// Has suspect vertex i retracted from another place from now on, where it is moved.
  void restartAt(std::size_t i, const Vec3f& place);

  /// The quads at suspect vertices of these numbers, sorted. Runs in parallel. \throws Cancelled.
  [[nodiscard]] std::vector<EdgeRef> quadsAt(std::span<const std::size_t> vertices) const;
  /// Whether no vertex of the edge's quad may still be moved.
  [[nodiscard]] bool fixed(const EdgeRef& e) const;
  /// The edge's quad with the other diagonal.
  [[nodiscard]] Quad turned(const EdgeRef& e) const;
  /// Gives quads their other diagonals. \param edges sorted; none has been turned before.
  void turn(const std::vector<EdgeRef>& edges);
  /// Whether turn() has had the edge.
  [[nodiscard]] bool turnedBefore(const EdgeRef& e) const;
  /// Gives each of these quads that is fixed a diagonal both of whose triangles the lattice edge passes in the right
  /// direction, or makes it a fan. Runs in parallel. \throws Cancelled.
  void chooseSafeDiagonals(const std::vector<EdgeRef>& edges);
  /// How often quads got their other diagonals.
  [[nodiscard]] std::size_t turnCount() const { return mTurnCount; }

 private:
  EdgeCells mEdgeCells;
  Fans mFans;
  std::vector<VertexState> mVertices;
  std::vector<std::uint8_t> mAtEnd;  ///< Beside mVertices, whether it is fully retracted: small, as it is asked often.
  std::vector<std::size_t> mOnCreases;
  FaceTests mFaces;
  Mesh& mMesh;
  const Monitor& mMonitor;
  std::vector<EdgeRef> mTurned;  ///< What turn() has had, sorted.
  std::size_t mTurnCount = 0;
};

}  // namespace pdc::detail
