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

/// What HermiteSource::surfaceBlocks() gives, and how many of the sign-changing edges have an end without data; none
/// where the surface is open.
struct GridBlocks {
  SurfaceBlocks blocks;
  std::size_t crossingsWithoutData = 0;
};

/// The part of GridSource that depends on the value type.
class GridSampler {
 public:
  virtual ~GridSampler() = default;
  /// \param weight null, or values on the same lattice: points where they are not positive have no data.
  [[nodiscard]] virtual GridBlocks surfaceBlocks(const Monitor& monitor, const GridSampler* weight) const = 0;
  /// The points of a leaf or tile whose values are above zero and finite; bits as in CellMask.
  [[nodiscard]] virtual CellMask positivePoints(const Coord& block) const = 0;
  [[nodiscard]] virtual SurfaceForecast forecast(const Monitor& monitor) const = 0;
  virtual void prefetch(const Coord& block) const = 0;
  virtual void fillHermite(const SurfaceBlock& block, const LatticeMap& map, HermiteBlock& hermite) const = 0;
  /// Returns up to `most` leaves, as blocks; see sampleOfBlocks().
  [[nodiscard]] virtual std::vector<Coord> someLeaves(std::size_t most) const = 0;
  /// Reads the values about a block, times `scale`, into the rows that the stencil asks for; NaN where a value is
  /// clamped or not finite. Other rows are left as they are.
  virtual void readDistances(const Coord& block, float scale, DistanceStencil& stencil) const = 0;
};

/// \returns null if the grid's type is none of ContourableGrids.
std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid, const GridReading& reading);

}  // namespace pdc::detail
