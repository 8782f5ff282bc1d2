#pragma once

#include <cstdint>
#include <vector>

#include "simplify/decimation/local_frame.h"

namespace pdc::detail {

/// What decimation works on, in its local frame.
struct DecimatedSurface {
  LocalFrame frame;
  std::vector<Vec3d> positions;
  Buffer<Triangle> faces;
  std::vector<std::uint8_t> locked;  ///< By vertex, whether it stays where it is.
};

/// The surface before it was decimated.
struct GivenSurface {
  std::vector<Vec3d> positions;
  Buffer<Triangle> faces;
};

}  // namespace pdc::detail
