#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "pdc/sample/dense/volume_view.h"
#include "pdc/sample/hermite_mode.h"
#include "pdc/sample/hermite_source.h"
#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc {

/// The most points that a dense volume may have along an axis.
inline constexpr std::int64_t kMostVolumePoints = std::int64_t{1} << 30;

struct DenseSourceOptions {
  /// Isovalue in the meaning of the values, after slope and intercept; finite. Default: 0 for level sets; the middle
  /// between the two values of booleans and of volumes that hold no others; otherwise otsuThreshold().
  std::optional<double> iso{};
  /// false: all beyond the array is outside, so the surface is closed. true: only cells whose eight corners lie in the
  /// array, and in the mask and have a weight above 0 where there are such, take part.
  bool open = false;
  /// false: NaN and infinite values are an error, unless the mask leaves them out. true: they are outside, and none is
  /// used for a normal.
  bool acceptNonFinite = false;
  HermiteMode hermite = HermiteMode::kAuto;
  std::optional<GridClass> gridClass{};  ///< Empty: decided by the values.
  std::optional<InsideValues> inside{};  ///< Empty: low in level sets, high in fog volumes; see DenseSource.
  /// Standard deviation of each value, in its meaning's units, >= 0. As many points as the values, of any type and
  /// strides, like the two below. Values that are negative or not finite count as 0 (see DenseSource::refusedNoise).
  std::optional<VolumeView> sigma{};
  /// How much each value counts beside others, >= 0; see GridSourceOptions::weight.
  std::optional<VolumeView> weight{};
  /// Points where the stored number is not above zero have no data: where the surface is closed they are like points
  /// beyond the array.
  std::optional<VolumeView> mask{};
};

/// Values on a box of the lattice, read where they lie in memory: of any type, byte order and strides, without a copy.
/// Lattice point (0, 0, 0) is the first voxel's centre.
///
/// Gives what GridSource gives of a grid with the same values, byte for byte, as far as the surface keeps three voxels
/// from the array's border: the same rules for what is inside, for values on the isovalue, for planes from distances
/// and for noise hold. A level set whose values end in a band, as where they are truncated, is one here too: there the
/// largest values stand for all beyond.
///
/// The class is that of the options, or is decided by the values as readMeaning() does where a grid has none, except
/// that signed values that are no distances are a fog volume where they are integers, or where the outermost ones are
/// as low as any. Inside is low in level sets and high in fog volumes; it is high in level sets where all outermost
/// values are negative.
///
/// A solid that reaches the array's border is closed by a flat cap, half a voxel beyond the outermost points, and the
/// crease between cap and surface is kept. Differences beside the border are one-sided.
///
/// Values count in single precision, after the isovalue was subtracted in double precision.
///
/// The views must not change while the source lives. Its functions may be called from many threads at once. Making one
/// may read all values once, in parallel on the calling thread's arena, to decide what they mean: not if class and
/// isovalue are given. It takes no memory of the volume's size; surfaceBlocks() takes one bit a voxel at most.
class DenseSource final : public HermiteSource {
 public:
  /// \param owner keeps what the views look at alive; may be null.
  /// \throws std::invalid_argument where a view has no data. \throws Error for a volume without points, or with more
  /// than kMostVolumePoints along an axis; an isovalue, slope or intercept that is not finite, a slope of zero; a σ,
  /// weight or mask of another size; kDistance where the map is not affine.
  DenseSource(const VolumeView& values, const LatticeMap& map, const DenseSourceOptions& options = {},
              std::shared_ptr<const void> owner = {});
  ~DenseSource() override;

  /// \throws Cancelled; Error for values that are not finite, unless they are accepted.
  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const override;
  /// From some of the blocks.
  [[nodiscard]] std::optional<SurfaceForecast> forecast(const Monitor& monitor) const override;
  [[nodiscard]] const LatticeMap& map() const override;
  [[nodiscard]] SourceKnowledge knowledge() const override;
  void fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const override;
  void fillNoise(const SurfaceBlock& block, const HermiteBlock& hermite, PlaneNoise& noise) const override;
  void fillFeaturePlanes(const SurfaceBlock& block, const HermiteBlock& hermite, std::span<const SurfacePatch> patches,
                         FeaturePlanes& planes) const override;
  void prefetch(const Coord& block) const override;

  /// The isovalue in use, in the meaning of the values; finite.
  [[nodiscard]] double iso() const;
  /// True if inside is where values are above the isovalue.
  [[nodiscard]] bool insideIsHigher() const;
  /// How the values are read, why, and where that is doubtful.
  [[nodiscard]] const GridMeaning& meaning() const;
  /// True if planes beside creases come from distances.
  [[nodiscard]] bool usesDistances() const;
  /// Standard deviation of white noise in the distances, in voxels, as estimated, >= 0; 0 if no distances are used.
  [[nodiscard]] double valueNoise() const;
  /// The number of values of σ and weight that are negative or not finite.
  [[nodiscard]] std::size_t refusedNoise() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> mImpl;
};

}  // namespace pdc
