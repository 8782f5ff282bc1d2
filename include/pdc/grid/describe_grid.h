#pragma once

#include <openvdb/Grid.h>

#include <array>
#include <cstddef>

#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc {

/// What a person needs to know of a grid of floats or doubles before choosing an isovalue and steps.
struct GridDescription {
  static constexpr std::size_t kBins = 16;

  GridMeaning meaning;       ///< Class, side, isovalue, band, and doubts: signs that were never flooded, for one.
  double low = 0, high = 0;  ///< Of the active values that are finite; equal where there are none.
  std::array<std::size_t, kBins> histogram{};  ///< Numbers of active voxels in equal parts of that range.
  std::size_t nonFinite = 0;                   ///< Values that are NaN or infinite.
  std::size_t parts = 0, cavities = 0;  ///< Of the solid at meaning.iso; see keepComponents() and fillCavities().
  double noise = 0;  ///< Standard deviation of the values of a level set of distances, in voxels; 0 if it is not known.
};

/// Looks at all values. The grid is not changed, but copied where it has to be repaired to be read.
/// \throws std::invalid_argument for null; Error for other value types, and what readMeaning() and GridSource throw.
[[nodiscard]] GridDescription describeGrid(const openvdb::GridBase::ConstPtr& grid);

}  // namespace pdc
