#pragma once

#include "pdc/sample/hermite_source.h"
#include "sample/dense/volume_signs.h"

namespace pdc::detail {

/// Which points of a volume have data.
struct VolumeData {
  std::array<std::int64_t, 3> size;
  const VolumeSigns* mask = nullptr;    ///< Null, or those that it says inside of.
  const VolumeSigns* weight = nullptr;  ///< As mask.

  /// Those of a block, bits as in CellMask.
  [[nodiscard]] CellMask points(const Coord& block) const;
};

/// The blocks that hold surface, sorted, with their signs. Runs in parallel. \param data null if the surface is closed;
/// otherwise only cells take part whose corners all have data. \throws Cancelled.
[[nodiscard]] SurfaceBlocks findVolumeBlocks(const VolumeSigns& signs, const VolumeData* data, const Monitor& monitor);

/// How large the surface is, from evenly spaced blocks.
[[nodiscard]] SurfaceForecast forecastVolumeBlocks(const VolumeSampler& values, const Monitor& monitor);

}  // namespace pdc::detail
