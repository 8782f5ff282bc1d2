#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Some layers of a volume, each the blocks of 8×8×8 cells of one x: from `begin` up to, but without, `end`, in blocks.
struct Slab {
  int begin = 0, end = 0;
  std::uint64_t vertices = 0;  ///< Those of its cells; certifying may add some.

  friend bool operator==(const Slab&, const Slab&) = default;
};

/// How a volume is cut, and what all slabs have in common.
struct SlabPlan {
  std::vector<Slab> slabs;  ///< One beside the other, by ascending x; none where there is no surface.
  Vec3d origin{};           ///< See Mesh::origin.
  double step = 0;          ///< What coordinates are multiples of; 0: whatever single precision holds.
};

/// Into how many slabs a volume is cut.
struct SlabLimits {
  int slabs = 0;  ///< That many, as alike as whole layers allow; 0: as few as fit.
  std::size_t maxMemory =
      0;  ///< Bytes that the program may have in use while it contours one. 0: what the machine has.
};

/// Cuts a surface into slabs of whole layers.
///
/// A slab is contoured with some layers about it, six by default (see runSlabs()), which count for its memory.
/// \throws std::invalid_argument for options that ContourOptions does not allow, and for `adaptive` and `quadrics`,
/// which are for whole meshes; Error if a single layer does not fit, or the mesh would have more than 2^32 vertices;
/// Cancelled; whatever the source throws.
[[nodiscard]] SlabPlan planSlabs(const HermiteSource& source, const ContourOptions& options, const SlabLimits& limits,
                                 const Monitor& monitor = {});

}  // namespace pdc
