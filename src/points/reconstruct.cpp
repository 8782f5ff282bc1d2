#include "pdc/points/reconstruct.h"

#include <cmath>
#include <stdexcept>

#include "parallel/stopwatch.h"
#include "pdc/error.h"
#include "pdc/subdivide/subdivide.h"
#include "points/mixture_surface.h"

namespace pdc {
Mesh reconstruct(const PointCloud& cloud, const ReconstructOptions& options, ReconstructReport* report,
                 Mesh* covarianceMesh, const Monitor& monitor) {
  constexpr int kMostSubdivisions = 31;
  if (options.subdivisions < 0 || options.subdivisions > kMostSubdivisions)
    throw std::invalid_argument("reconstruct: subdivisions must be 0 to 31");
  if (options.voxelSize && !(*options.voxelSize > 0 && std::isfinite(*options.voxelSize)))
    throw std::invalid_argument("reconstruct: voxelSize must be above 0 and finite");
  TriangulateOptions triangulation = options.triangulation;
  triangulation.close = triangulation.close || options.voxelSize.has_value();
  ReconstructReport own;
  detail::Stopwatch stopwatch;
  const GaussianMixture mixture = gaussianMixture(cloud, options.mixture, &own.mixture, monitor);
  own.gaussians = mixture.size();
  own.secondsMixture = stopwatch.lap();
  Mesh mesh = triangulate(mixture, triangulation, &own.triangulation, monitor);
  own.controlTriangles = mesh.triangles.size();
  own.secondsTriangulate = stopwatch.lap();
  if (mesh.triangles.empty())
    throw Error("no surface: no three of the points' Gaussians overlap; take a larger sigma0");
  if (covarianceMesh != nullptr) *covarianceMesh = mesh;
  if (options.subdivisions > 0) {
    SubdivideOptions subdivision{.levels = options.subdivisions, .limit = true};
    subdivision.covariances->source = CovarianceSource::kProperties;
    mesh = subdivide(mesh, subdivision, nullptr, monitor);
  }
  own.secondsSubdivide = stopwatch.lap();
  if (options.voxelSize)
    mesh = detail::contourMixture(mixture, {own.mixture.sigma0, static_cast<double>(own.mixture.points)}, mesh,
                                  *options.voxelSize, own.droppedParts, monitor);
  own.secondsContour = stopwatch.lap();
  if (report != nullptr) *report = own;
  return mesh;
}

}  // namespace pdc
