#pragma once

#include <cstddef>

#include "extract/block_topology.h"
#include "extract/vertex_solver.h"

namespace pdc::detail {

/// What the choice of a quad's diagonal needs to know of each vertex: its place and the shape of its quadric's error
/// there.
struct VertexError {
  Vec3f x;  ///< Lattice units from the centre of the vertex' cell.
  SymMat3<float> A;
  Vec3f halfGradient;

  /// Growth of the error from the vertex to x + d.
  [[nodiscard]] float at(const Vec3f& d) const { return quadraticForm(A, d) + 2 * dot(halfGradient, d); }
};

struct VertexCounts {
  std::size_t crossings = 0, withoutNormal = 0, outOfCell = 0, moved = 0;
};

/// Where solved vertices go; all arrays have the mesh's number of vertices, `normals` may be null.
struct VertexOutput {
  Vec3f* positions;
  Vec3f* normals;
  VertexError* errors;
};

/// Samples and solves all blocks in parallel.
VertexCounts solveVertices(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                           const VertexSolver& solver, const VertexOutput& out, const Monitor& monitor);

}  // namespace pdc::detail
