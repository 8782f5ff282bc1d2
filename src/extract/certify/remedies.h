#pragma once

#include <vector>

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {

/// A remedy changes the mesh where that may resolve conflicts, and takes the conflicts it acts on out of the list.
/// \param conflicts sorted, as they are in `mesh` before any remedy of the round.
/// \returns the faces to be tested again: those that changed, and those whose conflicts wait for what that brought.
/// \throws Cancelled.
using Remedy = std::vector<EdgeRef>(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict>& conflicts);

/// Gives quads their other diagonal where that leaves them without conflict, each once at most. Must come first in a
/// round, as it asks for conflicts of the mesh as `near` saw it last.
[[nodiscard]] std::vector<EdgeRef> turnDiagonals(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict>& conflicts);
/// Moves vertices along their creases to where their faces have fewer conflicts (see findCreaseMoves). Conflicts at
/// their faces wait.
[[nodiscard]] std::vector<EdgeRef> moveAlongCreases(WorkingMesh& mesh, NearFaces& near,
                                                    std::vector<Conflict>& conflicts);
/// Retracts all vertices of conflicting triangles towards their safe places by a step.
[[nodiscard]] std::vector<EdgeRef> retractVertices(WorkingMesh& mesh, NearFaces& near,
                                                   std::vector<Conflict>& conflicts);
/// Replaces quads by fans, and splits cells where both faces are fans. Both in one: splitting a cell makes fans too,
/// which the conflicts after it meet.
[[nodiscard]] std::vector<EdgeRef> subdivideFaces(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict>& conflicts);

}  // namespace pdc::detail
