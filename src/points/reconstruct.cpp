#include "pdc/points/reconstruct.h"

#include <cmath>
#include <stdexcept>

#include "parallel/stopwatch.h"
#include "pdc/error.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "pdc/sample/vdb/grid_source.h"
#include "pdc/subdivide/subdivide.h"

namespace pdc {
namespace {

/// A closed surface anew, from the distances to it.
Mesh contourOf(const Mesh& surface, double voxelSize, const Monitor& monitor) {
  const GridVolume volume = meshToLevelSet(surface, {.voxelSize = voxelSize}, nullptr, monitor);
  return contour(GridSource(volume.grid), {.triangles = true}, nullptr, monitor);
}

}  // namespace

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
  if (options.voxelSize) mesh = contourOf(mesh, *options.voxelSize, monitor);
  own.secondsContour = stopwatch.lap();
  if (report != nullptr) *report = own;
  return mesh;
}

}  // namespace pdc
