#pragma once

#include <vector>

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {

/// Changes the mesh where that may resolve conflicts, and takes the conflicts it acts on out of the list.
/// \param conflicts sorted, as they are in `mesh` before any remedy of the round.
/// \returns the faces to be tested again: those that changed, and those whose conflicts wait for what that brought.
/// \throws Cancelled.
using Remedy = std::vector<EdgeRef>(WorkingMesh& mesh, const NearFaces& near, std::vector<Conflict>& conflicts);

/// Gives quads their other diagonal where that leaves them without conflict, each once at most. Must come first in a
/// round, as it asks for conflicts of the mesh as `near` saw it last.
[[nodiscard]] Remedy turnDiagonals;
/// Moves vertices along their creases to where their faces have fewer conflicts (see findCreaseMoves). Conflicts at
/// their faces wait.
[[nodiscard]] Remedy moveAlongCreases;
/// Retracts all vertices of conflicting triangles towards their safe places by a step.
[[nodiscard]] Remedy retractVertices;
/// Replaces quads by fans, and splits cells where both faces are fans. Both in one: splitting a cell makes fans too,
/// which the conflicts after it meet.
[[nodiscard]] Remedy subdivideFaces;

}  // namespace pdc::detail
