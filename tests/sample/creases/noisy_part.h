#pragma once

#include <openvdb/openvdb.h>

#include <cmath>
#include <random>

#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"

namespace pdc::test {

/// A box minus a cylinder.
inline FieldPtr drilledBox() { return subtract({box({0, 0, 0}, {1, 1, 0.5}), cylinder({0, 0, -1}, {0, 0, 1}, 0.6)}); }
inline constexpr Box kDrilledBoxBounds{{-1.3, -1.3, -0.8}, {1.3, 1.3, 0.8}};

/// Its level set, three voxels to either side, each value off by independent Gaussian noise. \param noise in voxels.
inline openvdb::FloatGrid::Ptr noisyLevelSet(double voxelSize, double noise, unsigned seed) {
  openvdb::initialize();
  const FieldPtr field = drilledBox();
  const double width = 3 * voxelSize;
  auto grid = openvdb::FloatGrid::create(static_cast<float>(width));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0, noise * voxelSize);
  auto values = grid->getAccessor();
  const int reach = static_cast<int>(1.3 / voxelSize) + 1;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const double d = field->valueAt({x * voxelSize, y * voxelSize, z * voxelSize}) + error(random);
        if (std::abs(d) < width) {
          values.setValue({x, y, z}, static_cast<float>(d));
        } else {
          values.setValueOff({x, y, z}, static_cast<float>(std::copysign(width, d)));
        }
      }
  return grid;
}

}  // namespace pdc::test
