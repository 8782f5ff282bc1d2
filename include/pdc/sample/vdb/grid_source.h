#pragma once

#include <openvdb/Grid.h>

#include <memory>
#include <optional>

#include "pdc/sample/hermite_mode.h"
#include "pdc/sample/hermite_source.h"
#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc {

struct GridSourceOptions {
  /// Isovalue in the grid's own units; finite. Default: 0 for level sets, 0.5 for fog volumes and booleans.
  std::optional<double> iso{};
  /// false: the tree is a function on all of space, tiles and background included, so the surface is closed.
  /// true: only cells whose eight corners are active, and have a weight above 0 where there is a weight grid, take
  /// part, so the surface ends where the data ends.
  bool open = false;
  /// false: NaN and infinite voxels are an error, wherever in the tree they are stored. true: they are outside, and
  /// none is used for a normal. A background that is not finite is outside without being asked for.
  bool acceptNonFinite = false;
  HermiteMode hermite = HermiteMode::kAuto;
  /// Standard deviation of each value, in its own units, >= 0; null if nothing is known. Like the grid it is a function
  /// on all of space, and has its background where nothing is active. It needs the grid's transform. Values that are
  /// negative or not finite count as 0 (see GridSource::refusedNoise).
  openvdb::GridBase::ConstPtr sigma{};
  /// How much each value counts beside others, >= 0, like the weights of a truncated signed distance; only ratios
  /// matter, but for 0: it is no data. Null, or a grid as for sigma.
  openvdb::GridBase::ConstPtr weight{};
  /// Empty: the class that the grid carries or, without one, that its values have: see readMeaning().
  std::optional<GridClass> gridClass{};
  /// Empty: decided from the grid, see readMeaning().
  std::optional<InsideValues> inside{};
  /// true: inactive values, tiles included, are set to what lies beyond the active ones beside them, on a copy of the
  /// grid: outside or inside by the end of the band. Only for level sets whose values end in a band.
  bool floodFill = false;
};

/// A scalar OpenVDB grid (float, double, int32, int64, bool) on its own lattice, read straight from its leaf buffers.
///
/// Inside is value < iso in level sets, value > iso in fog volumes, or as readMeaning() decides. A value that is the
/// isovalue is inside only between two insides along an axis, as where solids touch in a layer of lattice points, and
/// then counts as their mean. Crossings are linear along the edge; normals are the gradient of the trilinear
/// interpolant there (averaged over the four cells at the edge), through the inverse transpose of the transform. Values
/// at or beyond the background of a level set are treated as clamped: one-sided differences replace central ones there.
/// Transforms may be affine or frustums; a frustum's voxel size and sense are those at the centre of the active voxels.
///
/// The source shares the grids, which must not change while it lives. Its functions may be called from many threads at
/// once. Making one finds the tree's leaves, in parallel on the calling thread's arena.
///
/// Near a crease of a distance function central differences mix the normals of both sides, and linear crossings are
/// off. There planes come from one-sided slopes of the voxels around instead, as far as they have the length that
/// gradients of distances have and predict the values beside them (docs/features.md). HermiteMode::kAuto does so for
/// float and double grids that are level sets, with an affine transform, if over a sample of the band the median of |
/// |∇φ| − 1 | is at most 0.15 and the surface is not rough at the size of a voxel, as scanned meshes are whose facets
/// would all look like creases.
///
/// With a σ grid each crossing's plane has its own σn: the σ there, over the length of the gradient, propagated through
/// the differences that the normal is made of; at most 10, which is also that of crossings beside clamped values, where
/// the gradient is not known. Planes from distances take 1.15 times the largest σ at the crossings of their block in
/// place of the noise that is measured; where that is more than 0.3 voxels there are none. With a weight grid the
/// quadric of a crossing counts by the weight there; planes from distances do not.
class GridSource final : public HermiteSource {
 public:
  /// \throws std::invalid_argument for null. \throws Error for other value types; an isovalue that is not finite;
  /// transforms that are singular or not finite; leaves beyond index 2³⁰; kDistance where the transform is not affine;
  /// a σ or weight grid that is the grid itself, has another transform or is not scalar; flood filling of anything but
  /// a level set whose values end in a band.
  explicit GridSource(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options = {});
  ~GridSource() override;

  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  /// From some of the leaves; surface that passes between tiles is left out.
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override;
  [[nodiscard]] const LatticeMap& map() const override;
  [[nodiscard]] SourceKnowledge knowledge() const override;
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override;
  void fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const override;
  void fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                         FeaturePlanes& planes) const override;
  void prefetch(const Coord& block) const override;

  /// The isovalue in use, in the grid's own units; finite.
  [[nodiscard]] double iso() const;
  /// True if inside is where values are above the isovalue.
  [[nodiscard]] bool insideIsHigher() const;
  /// How the grid is read, why, and where that is doubtful.
  [[nodiscard]] const GridMeaning& meaning() const;
  /// True if planes beside creases come from distances.
  [[nodiscard]] bool usesDistances() const;
  /// Standard deviation of white noise in the distances, in voxels, as estimated, >= 0; 0 if no distances are used.
  [[nodiscard]] double valueNoise() const;
  /// The number of sign-changing edges that have an end of weight 0, where the surface is closed all the same; 0 if it
  /// is open or there are no weights. Takes as long as surfaceBlocks(). \throws what that does.
  [[nodiscard]] std::size_t crossingsWithoutData() const;
  /// The number of active values of the σ and weight grids that are negative or not finite; tiles count once.
  [[nodiscard]] std::size_t refusedNoise() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> mImpl;
};

}  // namespace pdc
