#pragma once

#include <functional>
#include <vector>

#include "eval/shapes.h"

namespace pdc::eval {

/// A kind of surface that people mesh, at the size in voxels at which they have it.
struct Kind {
  Shape shape;
  double size = 1;  ///< Voxels per unit of the shape.
  /// How far the surface reaches from the origin, in voxels.
  double reach = 0;
  /// Random poses over which figures are taken: more where a surface has few triangles.
  unsigned poses = 2;
  /// The direction in which distances grow near the surface; need not be of length one. Null: from distances.
  std::function<Vec3d(const Vec3d&)> gradient = nullptr;
};

/// Spheres of few voxels, droplets and overlapping spheres, strands, films, tori, filleted boxes, gyroids, rough blobs
/// of noise of one wavelength, and solids with sharp edges. \param heldOut those that nobody looked at while constants
/// were chosen.
[[nodiscard]] std::vector<Kind> makeKinds(bool heldOut);

}  // namespace pdc::eval
