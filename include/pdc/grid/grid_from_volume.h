#pragma once

#include <openvdb/openvdb.h>

#include "pdc/math/mat3.h"
#include "pdc/monitor.h"
#include "pdc/sample/dense/volume_view.h"

namespace pdc {

/// A grid with the values of a dense volume, in single precision, all of them active: index (0, 0, 0) is the first.
/// Values that are not finite are taken over. The same for any number of threads. Takes 4.2 bytes a voxel.
/// \param background of all beyond the volume. \throws std::invalid_argument and Error for views that DenseSource
/// refuses; Cancelled.
[[nodiscard]] openvdb::FloatGrid::Ptr gridFromVolume(const VolumeView& volume, const Mat3d& linear,
                                                     const Vec3d& translation, float background,
                                                     const Monitor& monitor = {});

}  // namespace pdc
