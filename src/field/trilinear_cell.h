#pragma once

#include <openvdb/math/Coord.h>

#include "pdc/math/vec3.h"

namespace pdc::detail {

inline double lerp(double a, double b, double t) { return a + (b - a) * t; }

/// The eight voxels about a point, and where between them it lies.
struct TrilinearCell {
  double v[2][2][2];  ///< [x][y][z]
  Vec3d t;            ///< 0 to 1 from the lower to the upper voxels.

  [[nodiscard]] double value() const {
    const AlongZ f = alongZ();
    return lerp(lerp(f.v00, f.v01, t.y), lerp(f.v10, f.v11, t.y), t.x);
  }

  /// The derivatives of value() with respect to t.
  [[nodiscard]] Vec3d gradient() const {
    const AlongZ f = alongZ();
    const double z0 = lerp(v[0][0][1] - v[0][0][0], v[0][1][1] - v[0][1][0], t.y);
    const double z1 = lerp(v[1][0][1] - v[1][0][0], v[1][1][1] - v[1][1][0], t.y);
    return {lerp(f.v10 - f.v00, f.v11 - f.v01, t.y), lerp(f.v01 - f.v00, f.v11 - f.v10, t.x), lerp(z0, z1, t.x)};
  }

 private:
  struct AlongZ {
    double v00, v01, v10, v11;
  };
  [[nodiscard]] AlongZ alongZ() const {
    return {lerp(v[0][0][0], v[0][0][1], t.z), lerp(v[0][1][0], v[0][1][1], t.z), lerp(v[1][0][0], v[1][0][1], t.z),
            lerp(v[1][1][0], v[1][1][1], t.z)};
  }
};

/// Fills cell.v with the voxels from `lower` to lower + 1, and searches the tree only once if one leaf holds them all.
template <typename Accessor>
void readVoxels(const Accessor& accessor, const openvdb::Coord& lower, TrilinearCell& cell) {
  using Leaf = typename Accessor::TreeType::LeafNodeType;
  constexpr int kLog2 = Leaf::LOG2DIM, kLast = Leaf::DIM - 1;
  const bool inOneLeaf = (lower.x() & kLast) != kLast && (lower.y() & kLast) != kLast && (lower.z() & kLast) != kLast;
  if (const Leaf* leaf = inOneLeaf ? accessor.template probeConstNode<Leaf>(lower) : nullptr) {
    const auto* values = leaf->buffer().data() + Leaf::coordToOffset(lower);
    for (int i = 0; i < 8; ++i)
      cell.v[i >> 2][i >> 1 & 1][i & 1] = values[((i >> 2) << 2 * kLog2) + ((i >> 1 & 1) << kLog2) + (i & 1)];
  } else {
    for (int i = 0; i < 8; ++i)
      cell.v[i >> 2][i >> 1 & 1][i & 1] = accessor.getValue(lower.offsetBy(i >> 2, i >> 1 & 1, i & 1));
  }
}

}  // namespace pdc::detail
