#pragma once

#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// Other ways to smooth meshes of triangles that are manifolds.

/// OpenMesh's Laplacian smoother, uniform weights, along and across the surface.
[[nodiscard]] Mesh openMeshLaplacian(const Mesh& mesh, int iterations);

/// CGAL's smooth_shape, mean curvature flow in implicit steps. \param time in squared mean edges, for all steps.
[[nodiscard]] Mesh cgalCurvatureFlow(const Mesh& mesh, double time, int steps);

/// Bilateral normal filtering, the local scheme (Zheng, Fu, Au & Tai 2011): normals of faces are averaged with those of
/// the faces that share a vertex, the less the farther these are and the more they differ; then vertices move to fit.
/// \param sigma of differences of unit normals. Distances have the mean one between middles of neighbours.
[[nodiscard]] Mesh bilateralNormals(const Mesh& mesh, double sigma, int normalIterations, int vertexIterations);

}  // namespace pdc::eval
