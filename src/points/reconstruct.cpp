#include "pdc/points/reconstruct.h"

#include <stdexcept>

#include "parallel/stopwatch.h"
#include "pdc/error.h"
#include "pdc/subdivide/subdivide.h"

namespace pdc {

Mesh reconstruct(const PointCloud& cloud, const ReconstructOptions& options, ReconstructReport* report,
                 Mesh* covarianceMesh, const Monitor& monitor) {
  constexpr int kMostSubdivisions = 31;
  if (options.subdivisions < 0 || options.subdivisions > kMostSubdivisions)
    throw std::invalid_argument("reconstruct: subdivisions must be 0 to 31");
  ReconstructReport own;
  detail::Stopwatch stopwatch;
  const GaussianMixture mixture = gaussianMixture(cloud, options.mixture, &own.mixture, monitor);
  own.gaussians = mixture.size();
  own.secondsMixture = stopwatch.lap();
  Mesh mesh = triangulate(mixture, options.triangulation, &own.triangulation, monitor);
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
  if (report != nullptr) *report = own;
  return mesh;
}

}  // namespace pdc
