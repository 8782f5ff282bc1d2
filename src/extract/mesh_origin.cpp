#include "extract/mesh_origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/nearest_multiple.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/math/box.h"
#include "sample/block_origin.h"

namespace pdc::detail {
namespace {

/// A box in the world about all cells of the blocks, with room for vertices outside of their cells.
Box worldBox(const LatticeMap& map, const SurfaceBlocks& blocks) {
  constexpr double kRoom = 2;  // lattice units
  Box box = Box::empty();
  for (const Coord& block : blocks.coords) {
    const Vec3d low = blockOrigin(block);
    for (int corner = 0; corner < 8; ++corner) {
      Vec3d at = low;
      for (int axis = 0; axis < 3; ++axis) at[axis] += (corner >> axis & 1) != 0 ? kBlockSize + kRoom : -kRoom;
      box.include(map.position(at));
    }
  }
  return box;
}

/// Near the centre, on a power of two that is coarse beside the box: then it has few digits.
Vec3d chosenOrigin(const Box& box, double voxelSize) {
  const double reach = largestEntry(box);
  const double spacing = reach * std::numeric_limits<float>::epsilon();
  if (!(spacing > kMostRounding * voxelSize)) return {};
  const Vec3d size = box.hi - box.lo;
  constexpr int kEighth = -3;
  const double unit = std::ldexp(1.0, std::ilogb(std::max({size.x, size.y, size.z})) + kEighth);
  return nearestMultiple(box.center(), unit);
}

/// The finest power of two of which all sums up to `largest` in size are exact multiples in double precision.
double exactStep(double largest) {
  return std::ldexp(1.0, std::ilogb(largest) + 1 - std::numeric_limits<double>::digits);
}

/// \throws Error if single precision cannot tell neighbouring voxels apart relative to the origin.
void checkReach(const Box& box, const Vec3d& origin, double voxelSize) {
  const double reach = largestEntry(Box{box.lo - origin, box.hi - origin});
  const double spacing = reach * std::numeric_limits<float>::epsilon();
  if (!(spacing < voxelSize))
    throw Error(
        fmt::format("the origin ({}, {}, {}) is up to {:.3g} away from the surface, where single precision has "
                    "steps of {:.2g} voxels, at most 1 is allowed",
                    origin.x, origin.y, origin.z, reach, spacing / voxelSize));
}

}  // namespace

MeshOrigin meshOrigin(const LatticeMap& map, const SurfaceBlocks& blocks, const std::optional<Vec3d>& wanted,
                      bool exactSums) {
  if (blocks.coords.empty() || wanted == Vec3d{}) return {.origin = wanted.value_or(Vec3d{})};
  const Box box = worldBox(map, blocks);
  MeshOrigin result{.origin = wanted ? *wanted : chosenOrigin(box, map.voxelSize())};
  if (wanted) checkReach(box, *wanted, map.voxelSize());
  if (exactSums && result.origin != Vec3d{}) {
    const Vec3d& o = result.origin;
    result.step = exactStep(std::max(largestEntry(box), largestEntry(o)));
    result.origin = nearestMultiple(o, result.step);
  }
  return result;
}

}  // namespace pdc::detail
