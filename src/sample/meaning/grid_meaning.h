#pragma once

#include <openvdb/Grid.h>

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "pdc/sample/lattice_map.h"
#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc::detail {

/// What a grid's values say of what they mean. Values that are not finite are left out everywhere.
struct GridEvidence {
  double background = 0;
  double voxelSize = 1;           ///< World units.
  bool mask = false;              ///< The grid is of booleans, and nothing below was looked at.
  double low = 0, high = 0;       ///< The range of active values and the background; see gatherEvidence().
  std::vector<double> outermost;  ///< The active values farthest along each axis, up and down, in any order.

  // What a sample of the leaves says:
  /// Median length of the gradient, per world unit; 0 if there are too few values beside which all are active.
  double slope = 0;
  /// Median of |length / slope − 1|. Infinite where slope is 0.
  double slopeSpread = std::numeric_limits<double>::infinity();
  /// As slope, of the values within about a voxel of zero; 0 if there are too few.
  double slopeAtZero = 0;
  /// The share of active values farther from zero than the background.
  double beyondBackground = 0;
  /// Numbers of pairs of an active value and an inactive neighbour: ends[1][0] has a positive value beside a negative
  /// one, and so on. Zeros count as neither.
  std::array<std::array<std::size_t, 2>, 2> ends{};
};

/// Looks at a grid of a type that can be contoured. \param known the grid's class; the range is that of all values
/// where it is not known, and where a sample of a level set has no negative value. \param weight null, or a grid: what
/// has no weight above 0 in it is left out of what is outermost.
[[nodiscard]] GridEvidence gatherEvidence(const openvdb::GridBase& grid, const LatticeMap& map,
                                          const std::optional<GridClass>& known, const openvdb::GridBase* weight);

/// What is read of a grid, and with which background.
struct Reading {
  GridMeaning meaning;
  double clamp = 0;                    ///< See ReadableGrid.
  std::optional<double> background{};  ///< What the background must become to be outside; empty where it is.
  /// The background is no end of a band but what an array was filled with beyond its ends: within the box of the active
  /// values, those that equal it are inactive, but values like others.
  bool array = false;
};

/// The rules of readMeaning(). \param fileClass that of the grid, if it has one.
[[nodiscard]] Reading decideMeaning(const GridEvidence& evidence, const std::optional<GridClass>& fileClass,
                                    const GridMeaningOptions& options);

}  // namespace pdc::detail
