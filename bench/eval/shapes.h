#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pdc/math/mat3.h"
#include "pdc/math/vec3.h"

/// Solids with exact signed distances and known edges, about the origin, in units of half their size.
namespace pdc::eval {

using Segment = std::array<Vec3d, 2>;

/// A fine triangle mesh of a solid, counter-clockwise seen from outside.
struct ShapeMesh {
  std::vector<Vec3d> points;
  std::vector<std::array<int, 3>> triangles;
};

struct Shape {
  std::string name;
  bool heldOut;                                  ///< Nobody looked at it while constants were chosen.
  std::function<double(const Vec3d&)> distance;  ///< Negative inside; exact, so its gradient is of length one.
  std::vector<Segment> edges;                    ///< The creases that are measured, curved ones as short segments.
  std::vector<Segment> creases;                  ///< All creases.
  std::vector<Vec3d> corners;
  ShapeMesh mesh;
};

/// A shape without creases, and without a mesh.
[[nodiscard]] Shape smoothShape(std::string name, bool heldOut, std::function<double(const Vec3d&)> distance);

/// All shapes for solids whose half size is `voxels` voxels, which is what the thickness of the thin plate, 1.5 voxels,
/// depends on.
[[nodiscard]] std::vector<Shape> makeShapes(double voxels);

/// Where a solid lies: x_world = size · rotation · x + offset. One voxel is one world unit.
struct Pose {
  double size;
  Mat3d rotation;
  Vec3d offset;

  [[nodiscard]] Vec3d toWorld(const Vec3d& x) const { return rotation * x * size + offset; }
  [[nodiscard]] Vec3d toShape(const Vec3d& x) const { return rotation.transposed() * (x - offset) * (1 / size); }
};

/// A random pose that depends on the number alone, the same on every machine of a kind.
[[nodiscard]] Pose randomPose(unsigned seed, double size);

}  // namespace pdc::eval
