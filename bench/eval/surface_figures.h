#pragma once

#include <vector>

#include "eval/kinds.h"
#include "eval/nearest.h"
#include "pdc/mesh/mesh.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::eval {

/// How far a mesh as a surface is from the surface that it stands for. Lengths in voxels, angles in degrees.
struct SurfaceFigures {
  double vertexRms = 0;   ///< Distance of the vertices from the surface.
  double surfaceRms = 0;  ///< Distances of points of the faces from the surface and of its points from them, by area.
  double normalRms = 0, normalP99 = 0,
         normalMax = 0;               ///< Errors of the faces, by area, farther than kAway from creases.
  double edgeRms = 0, cornerMax = 0;  ///< As in Figures.
  std::size_t triangles = 0;
  std::size_t turned = 0;  ///< Triangles more than kTurned from the true normal, farther than kAway from creases.
  static constexpr double kAway = 1, kTurned = 60;
};

/// A kind in a pose, and points of its surface, about one per square voxel.
class PosedKind {
 public:
  PosedKind(const Kind& kind, const Pose& pose, unsigned seed);

  [[nodiscard]] const Kind& kind() const { return mKind; }
  [[nodiscard]] const Pose& pose() const { return mPose; }
  /// In voxels, of a point in world space.
  [[nodiscard]] double distance(const Vec3d& p) const { return mKind.shape.distance(mPose.toShape(p)) * mPose.size; }
  [[nodiscard]] Vec3d normal(const Vec3d& p) const;
  [[nodiscard]] SurfaceFigures measure(const Mesh& mesh) const;
  [[nodiscard]] bool awayFromCreases(const Vec3d& p) const { return mCreases.distance(p) >= SurfaceFigures::kAway; }

 private:
  const Kind& mKind;
  Pose mPose;
  Nearest mCreases{SurfaceFigures::kAway};
  std::vector<Vec3f> mPoints;
};

/// The noise of a source's normals: the root mean square of what one component of them is off, in a direction along
/// the surface, farther than kAway from creases.
[[nodiscard]] double trueNormalNoise(const HermiteSource& source, const PosedKind& posed);

/// Figures over several poses: roots of mean squares, means of percentiles, the largest of maxima, and sums of counts.
[[nodiscard]] SurfaceFigures pool(const std::vector<SurfaceFigures>& all);

}  // namespace pdc::eval
