#pragma once

#include <cstddef>
#include <memory>

#include "pdc/field/field.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {
namespace detail {
class SimplifiedFields;
}

/// The most voxels that a FieldSource's lattice may have along an axis.
inline constexpr int kMaxVoxelsPerAxis = 1 << 20;

/// A FieldSource that has seen more lattice points than this without a finite value looks for no more.
inline constexpr std::size_t kMostCountedPoints = 10'000'000;

/// Voxels along a side of a FieldSource's box: as many as cover it, but at least one. A side that exceeds a whole
/// number of voxels by less than 1e-9 voxel has that number. Both lengths in the same unit, finite, voxelSize > 0,
/// their ratio below 2^63.
[[nodiscard]] long long voxelsAlong(double side, double voxelSize);

struct FieldSourceOptions {
  Box box;               ///< World units. The surface is looked for inside it.
  double voxelSize = 0;  ///< World units, > 0. The lattice starts at box.lo; see voxelsAlong().
  double iso = 0;        ///< The surface is where the field equals this; see isInside() for values on it.
  /// false: the solid is cut off at the box and the mesh is closed. true: the surface ends within a voxel of the box.
  bool open = false;
  /// false: a function that is NaN or infinite at a lattice point of the box that is looked at is an error. true: it is
  /// outside there. Lattice points of blocks that bound() excludes are not looked at.
  bool acceptNonFinite = false;
};

/// An implicit function on a uniform lattice.
///
/// Blocks are found by descending from the box and dropping every box whose bound() excludes the iso value, so time and
/// memory grow with the surface. Where bound() is infinite on a side and decides nothing, a block is first sampled
/// every fourth lattice point; the surface is then followed across block faces from where it was seen, so only
/// components that slip through that coarse lattice altogether are missed. Crossings are bracketed to 2^-20 of the
/// edge; normals are the field's gradients there, or a hair inside the edge where it is crossed at its end, and, where
/// those are not finite or zero, central differences. A field of many parts costs what the parts near a block cost, see
/// Field::simplified(), with the same results. \throws Error for an empty box, a voxel size that is not
/// positive, gives too many voxels or is below 2^-32 of the box's coordinates; std::invalid_argument for null.
class FieldSource final : public HermiteSource {
 public:
  FieldSource(FieldPtr field, const FieldSourceOptions& options);

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  /// Where bounds decide nothing it knows only the memory for the blocks that are looked at, and what some of them
  /// hold.
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override;
  [[nodiscard]] SourceKnowledge knowledge() const override { return {.exactNormals = true}; }
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override;
  [[nodiscard]] const LatticeMap& map() const override { return mMap; }
  /// What is contoured: zero on the surface, negative inside, cut off at the box unless open.
  [[nodiscard]] const FieldPtr& levelField() const { return mField; }

 private:
  FieldPtr mFunction;  ///< What was given.
  FieldPtr mField;
  FieldSourceOptions mOptions;
  std::shared_ptr<const detail::SimplifiedFields> mFields;  ///< Of mField.
  LatticeMap mMap;
};

}  // namespace pdc
