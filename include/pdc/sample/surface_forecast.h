#pragma once

namespace pdc {

/// How large a surface is, estimated without finding all of it.
struct SurfaceForecast {
  double blocks = 0;     ///< Blocks that hold surface.
  double crossings = 0;  ///< Sign-changing lattice edges; a closed mesh has about as many vertices, and as many quads.
  double memory = 0;     ///< Bytes that finding its blocks takes, beyond those of the blocks themselves.
};

}  // namespace pdc
