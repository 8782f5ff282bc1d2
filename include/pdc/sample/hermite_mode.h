#pragma once

namespace pdc {

/// Where the planes of sampled values come from.
enum class HermiteMode {
  kAuto,      ///< kDistance where the values are distances: see GridSource.
  kGradient,  ///< Each crossing's plane from the gradient there, whatever the values mean.
  kDistance,  ///< Beside creases, from the distances and gradients of the voxels around: see GridSource.
};

}  // namespace pdc
