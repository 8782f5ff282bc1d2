#pragma once

#include <cstddef>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

struct ComparisonOptions {
  std::size_t samples = 1'000'000;  ///< Points on each of the two surfaces; takes 8 bytes each.
};

/// Distances from points of one surface to the nearest point of another, in world units.
struct DistanceFigures {
  double mean = 0, rms = 0;  ///< Over the surface's area.
  double p999 = 0;           ///< The 99.9th percentile over the area.
  double largest = 0;        ///< Over the samples and all vertices of the surface's faces.
  std::size_t samples = 0;
};

/// How far two surfaces are from each other. Angles are in degrees, from 0 to 180: between the normal of the face that
/// a sample lies on and that of the nearest face of the other mesh. Where several are equally near it is the one with
/// the smallest angle; samples whose nearest face has no area are left out.
struct MeshComparison {
  DistanceFigures toReference;         ///< From the mesh.
  DistanceFigures fromReference;       ///< To the mesh.
  double meanAngle = 0, rmsAngle = 0;  ///< Over the samples of both.
  double opposedShare = 0;             ///< Of the mesh's samples: those with an angle above 90 degrees.
};

/// Compares by points spread evenly over the area of either mesh; the same points for the same mesh. Quads are the two
/// triangles they stand for. Faces with a NaN or infinite corner are left out. The meshes may have different origins.
///
/// Runs in parallel; the result does not depend on the number of threads. The time is that of finding the nearest
/// triangle to each sample and vertex.
///
/// \throws Error if either mesh has no face with finite corners and an area, or a face that names a vertex that does
/// not exist; std::invalid_argument for no samples, and as Mesh says; Cancelled.
[[nodiscard]] MeshComparison compareMeshes(const Mesh& mesh, const Mesh& reference,
                                           const ComparisonOptions& options = {}, const Monitor& monitor = {});

}  // namespace pdc
