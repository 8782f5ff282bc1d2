#pragma once

#include <openvdb/Grid.h>

#include <cstddef>
#include <string>
#include <vector>

#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc {

/// A grid whose values have a settled meaning: what the functions of pdc/grid take, change and leave. They share
/// nothing with other grids. After an exception the grid is not to be used.
struct GridVolume {
  /// A FloatGrid or DoubleGrid of class level set or fog volume, never null, without NaN and infinite values. A level
  /// set is negative inside and its background is outside.
  openvdb::GridBase::Ptr grid;
  GridClass gridClass = GridClass::kLevelSet;
  InsideValues inside = InsideValues::kLow;  ///< High for most fog volumes.
  double iso = 0;                            ///< Where the surface is, in the grid's units; finite.
  /// A level set's values are distances in world units, in a band of three voxels or more. What needs that makes it so.
  bool distances = false;
};

/// What one step did to a grid.
struct GridStepReport {
  std::string name;                               ///< As the program's option has it, without dashes.
  std::string parameter;                          ///< As the program's option has it.
  std::size_t voxelsBefore = 0, voxelsAfter = 0;  ///< Active ones; tiles by their voxels.
  std::size_t partsBefore = 0, partsAfter = 0;    ///< Where parts or cavities were looked at; else 0.
  std::vector<std::string> warnings;              ///< A line each.
};

/// How a grid is read before anything is done to it.
struct SettleOptions {
  GridMeaningOptions meaning{};
  bool acceptNonFinite = false;  ///< NaN and infinite values become the background; otherwise they are an error.
};

/// Decides what the values of a grid mean, as readMeaning() does, and makes a volume of it: the grid itself, which is
/// changed, or a copy where readMeaning() makes one. A level set that is positive inside is negated.
/// \param meaning becomes how the grid was read, if it is not null.
/// \throws std::invalid_argument for null; Error for value types other than float and double, for values that are not
/// finite, and what readMeaning() throws.
[[nodiscard]] GridVolume settleGrid(openvdb::GridBase::Ptr grid, const SettleOptions& options = {},
                                    GridMeaning* meaning = nullptr);

}  // namespace pdc
