#pragma once

#include "pdc/sample/dense/dense_source.h"
#include "sample/dense/volume_reader.h"

namespace pdc::detail {

/// How the values of a volume are read.
struct VolumeMeaning {
  GridMeaning meaning;
  double clamp = 0;  ///< See ReadableGrid.
};

/// Decides what values mean: see DenseSource. \param values reads them as they are. \param mask null, or which points
/// have data.
[[nodiscard]] VolumeMeaning readVolumeMeaning(const VolumeReader& values, const VolumeSigns* mask,
                                              const LatticeMap& map, const DenseSourceOptions& options);

}  // namespace pdc::detail
