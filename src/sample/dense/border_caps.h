#pragma once

#include <array>
#include <span>

#include "pdc/sample/hermite_source.h"
#include "sample/dense/volume_signs.h"

namespace pdc::detail {

/// Where a closed surface ends a solid that reaches beyond the data: half-way between the last points that have data
/// and the first that have none, across the axis between them.
class BorderCaps {
 public:
  /// \param mask null, or which points have data. Both must outlive this.
  BorderCaps(const std::array<std::int64_t, 3>& size, const VolumeSigns* mask, const LatticeMap& map)
      : mSize(size), mMask(mask), mMap(map) {}

  /// True if a block may hold such places.
  [[nodiscard]] bool mayTouch(const Coord& block) const;
  /// Sets the crossings there and their normals.
  void place(const SurfaceBlock& block, HermiteBlock& hermite) const;
  /// Says that these have no noise. \param weighted the values have weights.
  void clearNoise(const SurfaceBlock& block, bool weighted, PlaneNoise& noise) const;
  /// Replaces the planes of patches in which a cap meets another surface: the crease between them stays sharp.
  void addPlanes(const SurfaceBlock& block, const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                 FeaturePlanes& planes) const;

 private:
  [[nodiscard]] bool hasData(const Coord& point) const;
  template <typename Visit>
  void forEachCap(const SurfaceBlock& block, const Visit& visit) const;

  std::array<std::int64_t, 3> mSize;
  const VolumeSigns* mMask;
  const LatticeMap& mMap;
};

}  // namespace pdc::detail
