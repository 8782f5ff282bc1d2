#pragma once

#include <openvdb/Grid.h>

#include <memory>
#include <optional>

#include "pdc/sample/hermite_source.h"

namespace pdc {

/// Where a grid's planes come from.
enum class HermiteMode {
  kAuto,      ///< kDistance where the grid holds distances: see GridSource.
  kGradient,  ///< Each crossing's plane from the gradient there, whatever the values mean.
  kDistance,  ///< Beside creases, from the distances and gradients of the voxels around: see GridSource.
};

struct GridSourceOptions {
  /// Isovalue in the grid's own units. Default: 0 for level sets, 0.5 for fog volumes, booleans and unclassified
  /// densities.
  std::optional<double> iso{};
  /// false: the tree is a function on all of space, tiles and background included, so the surface is closed.
  /// true: only cells whose eight corners are active take part, so the surface ends where activity ends.
  bool open = false;
  /// false: NaN and infinite voxels are an error. true: NaN and +inf are outside, -inf is inside (with the grid's sense
  /// of inside), and none of them is used for a normal.
  bool acceptNonFinite = false;
  HermiteMode hermite = HermiteMode::kAuto;
};

/// A scalar OpenVDB grid (float, double, int32, int64, bool) on its own lattice, read straight from its leaf buffers.
///
/// Inside is value < iso; for fog volumes value > iso; for unclassified grids the side of iso that the background is
/// not on. Crossings are linear along the edge; normals are the gradient of the trilinear interpolant there (averaged
/// over the four cells at the edge), through the inverse transpose of the transform. Values at or beyond the background
/// of a level set are treated as clamped: one-sided differences replace central ones there. The grid must not change
/// while the source lives. Making one finds the tree's leaves, in parallel on the calling thread's arena. \throws Error
/// for other value types, singular or unsupported transforms, and leaves beyond index 2³⁰.
///
/// Near a crease of a distance function central differences mix the normals of both sides, and linear crossings are
/// off. There planes come from one-sided slopes of the voxels around instead, as far as they have the length that
/// gradients of distances have and predict the values beside them (docs/features.md). HermiteMode::kAuto does so for
/// float and double grids that are level sets, or unclassified about a positive background, with an affine transform,
/// if the median of | |∇φ| − 1 | over a sample of the band is at most 0.15; \throws Error where kDistance is asked for
/// and the transform is not affine.
class GridSource final : public HermiteSource {
 public:
  explicit GridSource(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options = {});
  ~GridSource() override;

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  void fillHermite(const Coord& block, const BlockSigns& signs, const EdgeIndex& edges,
                   HermiteBlock& hermite) const override;
  void expect(const Coord& block) const override;
  void fillFeaturePlanes(const Coord& block, const BlockSigns& signs, const EdgeIndex& edges,
                         const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                         FeaturePlanes& planes) const override;
  [[nodiscard]] const LatticeMap& map() const override;

  [[nodiscard]] double iso() const;
  [[nodiscard]] bool insideIsHigher() const;
  /// True if planes beside creases come from distances.
  [[nodiscard]] bool usesDistances() const;
  /// Standard deviation of white noise in the distances, in voxels, as estimated; 0 if none are used.
  [[nodiscard]] double valueNoise() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> mImpl;
};

}  // namespace pdc
