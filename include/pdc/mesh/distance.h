#pragma once

#include <span>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// The distance from each point, in world coordinates, to the nearest point of the mesh's faces, in world units; quads
/// are the two triangles they stand for. NaN for a point that is not finite. Faces with a NaN or infinite corner are
/// left out.
///
/// Runs in parallel; the result does not depend on the number of threads. \throws Error if a face names a vertex that
/// does not exist, or if no face has finite corners; Cancelled.
[[nodiscard]] Buffer<double> distances(std::span<const Vec3f> points, const Mesh& mesh, const Monitor& monitor = {});

/// Distances from each vertex of a mesh, whose origin may be another one.
[[nodiscard]] Buffer<double> vertexDistances(const Mesh& from, const Mesh& mesh, const Monitor& monitor = {});

}  // namespace pdc
