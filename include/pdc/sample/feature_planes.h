#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/math/vec3.h"
#include "pdc/sample/lattice.h"

namespace pdc {

/// A piece of surface in one cell of a block, whose vertex is to be placed.
struct SurfacePatch {
  BlockCell cell;
  /// The sign-changing edges around it: the edge along axis a from (u, v) on the next two axes is bit 4a + u + 2v.
  std::uint16_t edges;
};

/// What a source knows of some patches of a block beyond their crossings: planes that take the place of the crossings'
/// own where those cannot be trusted, as beside a crease.
struct FeaturePlanes {
  /// A plane in lattice units from the block's origin: row · (x − point) is the distance from it in voxels, measured in
  /// world space, positive outside, times the square root of the plane's weight, in (0, 1].
  struct Plane {
    Vec3f point, row;
  };
  /// The planes of one patch.
  struct Patch {
    std::uint32_t patch;  ///< Position in the list of patches.
    std::uint32_t first, count;
    float sigmaNormal;  ///< Standard deviation of each component of the planes' unit normals.
  };

  std::vector<Patch> patches;  ///< By ascending patch, each with at least one plane.
  std::vector<Plane> planes;

  [[nodiscard]] std::span<const Plane> of(const Patch& p) const { return {planes.data() + p.first, p.count}; }
  /// What is known of patch i, or null.
  [[nodiscard]] const Patch* find(std::size_t i) const {
    const auto it =
        std::lower_bound(patches.begin(), patches.end(), i, [](const Patch& p, std::size_t n) { return p.patch < n; });
    return it != patches.end() && it->patch == i ? &*it : nullptr;
  }
  void clear() {
    patches.clear();
    planes.clear();
  }
};

}  // namespace pdc
