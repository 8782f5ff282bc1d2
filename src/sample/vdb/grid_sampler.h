#pragma once

#include <openvdb/Grid.h>

#include <memory>
#include <vector>

#include "pdc/sample/hermite_source.h"
#include "sample/stencils/distance_reader.h"
#include "sample/stencils/value_reading.h"

namespace pdc::detail {

/// What HermiteSource::surfaceBlocks() gives, and how many of the sign-changing edges have an end without data; none
/// where the surface is open.
struct GridBlocks {
  SurfaceBlocks blocks;
  std::size_t crossingsWithoutData = 0;
};

/// The part of GridSource that depends on the value type.
class GridSampler : public DistanceReader {
 public:
  /// \param weight null, or values on the same lattice: points where they are not positive have no data.
  [[nodiscard]] virtual GridBlocks surfaceBlocks(const Monitor& monitor, const GridSampler* weight) const = 0;
  /// The points of a leaf or tile whose values are above zero and finite; bits as in CellMask.
  [[nodiscard]] virtual CellMask positivePoints(const Coord& block) const = 0;
  [[nodiscard]] virtual SurfaceForecast forecast(const Monitor& monitor) const = 0;
  virtual void prefetch(const Coord& block) const = 0;
  virtual void fillHermite(const SurfaceBlock& block, const LatticeMap& map, HermiteBlock& hermite) const = 0;
  /// Returns up to `most` leaves, as blocks; see sampleOfBlocks().
  [[nodiscard]] virtual std::vector<Coord> someLeaves(std::size_t most) const = 0;
};

/// \returns null if the grid's type is none of ContourableGrids.
std::unique_ptr<const GridSampler> makeGridSampler(const openvdb::GridBase::ConstPtr& grid,
                                                   const ValueReading& reading);

}  // namespace pdc::detail
