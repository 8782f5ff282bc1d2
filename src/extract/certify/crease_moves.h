#pragma once

#include <cstddef>
#include <vector>

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {

/// Another place for a suspect vertex.
struct VertexMove {
  std::size_t vertex;  ///< Its number among the suspect ones.
  Vec3f place;         ///< In lattice units from the centre of its cell.
};

/// Looks for single vertices on sharp creases whose moving rids faces of conflicts, at little cost to the crease: tries
/// places along it first, which cost it nothing; then places within one of the sides that meet there, which cost flat
/// parts nothing; then places on the way to the safe one. Among those with the fewest conflicts left it takes the
/// first. It leaves out vertices that have moved a few times, and notes where it found no better place.
/// \param conflicts of the mesh as it is, found by `near`.
/// \returns moves of which no two share a conflict, by ascending vertex; none where the map is not affine, or in blocks
/// with so many conflicts that their faces are folded by noise. Runs in parallel. \throws Cancelled.
[[nodiscard]] std::vector<VertexMove> findCreaseMoves(WorkingMesh& mesh, NearFaces& near,
                                                      const std::vector<Conflict>& conflicts);

/// Looks for better places for vertices on sharp creases that are not where they are wanted.
/// \returns by ascending vertex the places where their faces have no conflict if no other vertex moves, nearer to the
/// planes of their creases than where they are; none where the map is not affine, or in blocks with so many such
/// vertices that their faces are folded by noise. Runs in parallel. \throws Cancelled.
[[nodiscard]] std::vector<VertexMove> findBetterPlaces(const WorkingMesh& mesh, NearFaces& near);

}  // namespace pdc::detail
