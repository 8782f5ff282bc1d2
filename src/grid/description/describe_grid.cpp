#include "pdc/grid/describe_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "grid/flip_parts.h"
#include "grid/real_grid.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

std::uint64_t voxelsOf(const openvdb::CoordBBox& box) { return box.volume(); }

/// Calls visit(value, voxels) for all active values.
template <typename GridT, typename Visit>
void forEachActive(const GridT& grid, const Visit& visit) {
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    const bool tile = !value.isVoxelValue();
    visit(static_cast<double>(*value), tile ? voxelsOf(value.getBoundingBox()) : 1);
  }
}

template <typename GridT>
void countValues(const GridT& grid, GridDescription& description) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  forEachActive(grid, [&](double value, std::uint64_t voxels) {
    if (!std::isfinite(value)) {
      description.nonFinite += voxels;
      return;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  });
  if (!(low <= high)) return;
  description.low = low;
  description.high = high;
  const double bins = static_cast<double>(GridDescription::kBins);
  forEachActive(grid, [&](double value, std::uint64_t voxels) {
    if (!std::isfinite(value)) return;
    // Halves, because the difference of two large numbers may be infinite.
    const double share = high > low ? (value / 2 - low / 2) / (high / 2 - low / 2) : 0;
    const auto bin = std::min(GridDescription::kBins - 1, static_cast<std::size_t>(share * bins));
    description.histogram[bin] += voxels;
  });
}

}  // namespace

GridDescription describeGrid(const openvdb::GridBase::ConstPtr& grid) {
  if (!grid) throw std::invalid_argument("describeGrid: the grid is null");
  GridDescription description;
  grid->apply<detail::RealGrids>([&](const auto& typed) { countValues(typed, description); });
  // What settling changes must not be what the caller sees.
  GridVolume volume = settleGrid(grid->deepCopyGrid(), {.acceptNonFinite = true}, &description.meaning);
  const auto never = [](std::size_t, std::uint64_t) { return false; };
  description.parts = detail::flipParts(volume, true, never).before;
  description.cavities = detail::flipParts(volume, false, never).before;
  const GridSource source(volume.grid, {.iso = volume.iso, .gridClass = volume.gridClass, .inside = volume.inside});
  description.noise = source.valueNoise();
  return description;
}

}  // namespace pdc
