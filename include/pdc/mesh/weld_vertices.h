#pragma once

#include <cstddef>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

struct WeldReport {
  std::size_t weldedVertices = 0;  ///< Vertices that became one with another of a lower number.
  std::size_t collapsedFaces = 0;  ///< Faces of which less than three corners were left: dropped.
};

/// Makes one vertex of all that lie within a distance of each other, so that faces come to share their vertices where
/// a file repeats them. Chains merge: a and c become one where both are near b, however far they are apart. The vertex
/// of the lowest number is the one that is kept, with its position, normal and properties, and the order of the
/// vertices stays. Which vertices become one does not depend on their order, nor the result on the number of threads.
///
/// Vertices with a NaN or infinite coordinate stay as they are. Of a quad with three corners left its triangle stays.
/// Nothing keeps faces from becoming duplicates, nor the surface a manifold, where the distance is larger than what the
/// mesh is made of.
///
/// \param mesh positions count as they are, without the origin. \param distance in world units, 0 or more; 0 welds
/// equal positions, and -0 is 0. Takes up to 300 bytes per vertex while it runs. \throws std::invalid_argument for a
/// distance out of range, and as Mesh says; Error as Mesh says; Cancelled. No progress is reported.
WeldReport weldVertices(Mesh& mesh, double distance, const Monitor& monitor = {});

/// Whether there are several faces and no vertex is a corner of two of them: each face then has a boundary all around,
/// as files do that write the corners of every face anew. \throws as Mesh says; polygons are faces too.
[[nodiscard]] bool isSoup(const Mesh& mesh);

}  // namespace pdc
