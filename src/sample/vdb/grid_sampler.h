#pragma once

#include <openvdb/Grid.h>

#include <memory>
#include <vector>

#include "pdc/sample/hermite_source.h"
#include "sample/creases/distance_stencil.h"

namespace pdc::detail {

/// How a grid's values are read as a function that is negative inside.
struct GridReading {
  double iso = 0;
  bool insideIsHigher = false;
  bool open = false;
  bool acceptNonFinite = false;
  /// The grid is a clamped distance: values this far from zero carry no slope. Infinite for other grids.
  double clamp = 0;
};

/// The part of GridSource that depends on the value type.
class GridSampler {
 public:
  virtual ~GridSampler() = default;
  [[nodiscard]] virtual SurfaceBlocks surfaceBlocks(const Monitor& monitor) const = 0;
  virtual void prefetch(const Coord& block) const = 0;
  virtual void fillHermite(const SurfaceBlock& block, const LatticeMap& map, HermiteBlock& hermite) const = 0;
  /// Returns up to `most` leaves, as blocks, spread evenly over the tree.
  [[nodiscard]] virtual std::vector<Coord> someLeaves(std::size_t most) const = 0;
  /// Reads the values about a block, times `scale`, into the rows that the stencil asks for; NaN where a value is
  /// clamped or not finite. Other rows are left as they are.
  virtual void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const = 0;
};

/// \returns null if the grid's type is none of ContourableGrids.
std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid, const GridReading& reading);

}  // namespace pdc::detail
