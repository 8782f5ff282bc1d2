#pragma once

#include <vector>

#include "extract/conflicts/fans.h"
#include "extract/topology/surface.h"
#include "extract/topology/suspect_vertex.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class CertifyHistory;

struct CertifyCounts {
  std::size_t shortened = 0, drawnIn = 0, forcedDiagonals = 0, fans = 0, uncertified = 0, addedBoundaryEdges = 0;
};

/// What is only noted for those who ask.
struct CertifyNotes {
  CertifyHistory* history = nullptr;
  std::vector<FanPart>* fans = nullptr;  ///< The fans in the mesh, in its order.
};

/// Moves suspect vertices, turns diagonals and replaces quads by fans until no triangle of the mesh meets another where
/// it should not or faces backwards along its lattice edge; see docs/soundness.md.
///
/// Only faces that hold a suspect vertex, or may face backwards, are tested, against all others near them, in the
/// mesh's own single precision by exact predicates. Quads are turned, vertices on creases moved to where their faces
/// have fewer conflicts (see findCreaseMoves). Then every suspect vertex of a conflicting pair of triangles is
/// retracted towards its safe place, step by step. Where all vertices are safe, quads become fans, and cells with
/// several patches or ambiguous faces are split (see Fans), which cannot intersect. Each round is decided from the
/// state before it, so the result does not depend on threads. Reports the stage "certify".
///
/// \param mesh as fillMesh made it, in quads only; may come back with triangles beside them.
/// \throws Cancelled within about the time of a block; Error if it would need more than 2^32 vertices.
CertifyCounts certify(const Surface& surface, const Suspects& suspects, Mesh& mesh, const Monitor& monitor,
                      const CertifyNotes& notes = {});

}  // namespace pdc::detail
