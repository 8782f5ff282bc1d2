#pragma once

#include <cstddef>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/points/gaussian_mixture.h"

namespace pdc {

struct TriangulateOptions {
  /// Gaussians are joined if their Bhattacharyya coefficient is at least this, above 0 and below 1. Two sheets whose
  /// distance is 4 standard deviations have exp(−2) = 0.135 and are kept apart by the default; the paper has 0.01.
  double leastOverlap = 0.15;
  /// The least angle between neighbouring triangles, π where they are flat, in (0, π). 60°; the paper has 30°, at which
  /// noise lets the surface fold back over itself.
  double leastDihedral = 1.0471975511965976;
  /// Also closes all boundaries: first as above with any overlap down to 1e-6, then by ears and fans. Not pretty, but
  /// closed.
  bool close = false;
  /// Boundaries of at most this many edges are closed in any case, by ears and fans: the greedy order leaves such gaps
  /// where fronts meet. 0 leaves all open.
  std::size_t mostGapEdges = 8;
  /// Components of fewer triangles are dropped.
  std::size_t leastTriangles = 8;
};

struct TriangulateReport {
  std::size_t seeds = 0;          ///< Triangles that the surface grew from.
  std::size_t components = 0;     ///< Of the result.
  std::size_t boundaryLoops = 0;  ///< Of the result.
  std::size_t nonManifoldRefused =
      0;  ///< Candidates that would have given an edge a third triangle, or turned one over.
  std::size_t overlappingRefused = 0;  ///< Candidates that would have lain on triangles there were.
  std::size_t splitVertices = 0;       ///< Vertices added where two parts of the surface met in one point only.
  std::size_t filledLoops = 0;         ///< Boundaries closed by ears and fans.
  std::size_t addedVertices = 0;       ///< Middles of fans.
  std::size_t droppedTriangles = 0;    ///< Of components that were too small.
  std::size_t unusedGaussians = 0;     ///< Without a triangle in the result.
};

/// A covariance mesh over the Gaussians of a mixture: a greedy triangulation whose front advances to the triangle with
/// the largest product of the Bhattacharyya coefficients of its edges and its flattest angle to its neighbours, from
/// several seeds (Preiner et al. 2019, section 6.2, equations 18 to 22). Triangles that would lie on others, and those
/// with an angle of less than 3°, are refused, and triangles at more than 120° to their neighbours come before all
/// others; that is ours.
///
/// \returns an oriented manifold, with boundary unless it was to be closed, whose vertices are the Gaussians that have
/// a triangle, in their order, then those added; their covariances are the properties of vertex_covariances.h, and
/// normals, where they are known, turn each component the way most of them point. Without normals they
/// face away from the middle of all Gaussians, so that closed ones have positive volumes. It is empty if no three
/// Gaussians overlap. The result does not depend on the number of threads. \throws std::invalid_argument for options
/// out of range and lists that are not as long as the means; Error for a mixture that is empty, with a covariance that
/// is not positive definite, or where too many Gaussians overlap for the memory; Cancelled. Progress: "overlaps",
/// "triangulate".
[[nodiscard]] Mesh triangulate(const GaussianMixture& mixture, const TriangulateOptions& options = {},
                               TriangulateReport* report = nullptr, const Monitor& monitor = {});

}  // namespace pdc
