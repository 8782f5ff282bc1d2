#pragma once

#include <optional>

#include "pdc/extract/contour.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/points/gaussian_mixture.h"
#include "pdc/points/point_cloud.h"
#include "pdc/points/triangulate_mixture.h"

namespace pdc {

struct ReconstructOptions {
  MixtureOptions mixture{};
  TriangulateOptions triangulation{};
  /// How many times the covariance mesh is refined, 0 to 31; its vertices are on the limit surface then.
  int subdivisions = 1;
  /// Contours the ridge of the mixture instead, with voxels of this size, in world units, above 0 and finite. The
  /// triangulation then closes all boundaries and tells what is inside. Not set: the subdivided surface.
  std::optional<double> voxelSize{};
};

struct ReconstructReport {
  MixtureReport mixture;
  TriangulateReport triangulation;
  std::size_t gaussians = 0, controlTriangles = 0;
  std::size_t droppedParts = 0;  ///< Of a contour: parts smaller than 8σ0, which are noise.
  double secondsMixture = 0, secondsTriangulate = 0, secondsSubdivide = 0, secondsContour = 0;  ///< Wall-clock time.
};

/// A surface from points that need no normals (Preiner et al. 2019): gaussianMixture(), triangulate(), and subdivide()
/// with products of Gaussians, whose limit surface runs along the ridge of the mixture.
///
/// \param covarianceMesh if given, what triangulate() made: with the covariances it is all that the surface needs.
/// With a voxel size that surface, closed, only tells what is inside and where about the ridge is; the ridge itself is
/// where the planes of the Gaussians, blended by their densities, are zero (docs/reconstruction.md), and their
/// deviations from their points are the noise of its normals. Creases come out sharper, and smooth parts as exact,
/// unless the noise is above half of σ0.
///
/// \returns triangles; as open as the covariance mesh. With a voxel size they are what contour() promises: closed,
/// manifold and free of self-intersections; parts thinner than a voxel or so are lost. \throws as those functions do;
/// Error if no three Gaussians overlap, and with a voxel size if they enclose nothing. The result depends neither on
/// the number of threads nor on the order of the points.
[[nodiscard]] Mesh reconstruct(const PointCloud& cloud, const ReconstructOptions& options = {},
                               ReconstructReport* report = nullptr, Mesh* covarianceMesh = nullptr,
                               const Monitor& monitor = {});

}  // namespace pdc
