#pragma once

#include <vector>

#include "eval/shapes.h"
#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// How far a mesh is from the solid that it stands for. Lengths are in voxels.
struct Figures {
  double vertexRms = 0, vertexMax = 0;  ///< Distance of the mesh's vertices from the surface.
  double edgeRms = 0, edgeMax = 0;      ///< Distance of points of the true edges from its triangles, at most kFar.
  double cornerMax = 0;                 ///< Distance of the true corners from its triangles, at most kFar.
  double normalP99 = 0;  ///< Degrees between triangle and surface normals, 99th percentile by count, farther than
                         ///< kAway from every crease.
  double edgeF1 = 0;     ///< Harmonic mean of the shares of its sharp edges (more than kSharp degrees) that lie within
                         ///< kNear of a true crease, and of points of the measured edges within kNear of a sharp edge.
  static constexpr double kFar = 2, kAway = 2, kSharp = 20, kNear = 0.1;
};

/// Distance of each vertex from the surface, in voxels.
[[nodiscard]] std::vector<double> vertexErrors(const Mesh& mesh, const Shape& shape, const Pose& pose);

/// Spearman's correlation: that of the places which values have when they are sorted. \pre a and b are equally long.
[[nodiscard]] double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

/// The part that is measured: everything, or vertices beyond the solid's middle along x and edges and corners before
/// it.
enum class Part { kAll, kHalves };

/// The figures of edges and corners alone.
[[nodiscard]] Figures measureEdges(const Mesh& mesh, const Shape& shape, const Pose& pose, Part part = Part::kAll);

[[nodiscard]] Figures measure(const Mesh& mesh, const Shape& shape, const Pose& pose, Part part = Part::kAll);

}  // namespace pdc::eval
