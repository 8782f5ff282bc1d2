#pragma once

#include <openvdb/Grid.h>

#include <optional>
#include <string_view>
#include <vector>

namespace pdc {

/// What the values of a grid are.
enum class GridClass {
  kLevelSet,   ///< A function that is zero on the surface, such as a signed distance.
  kFogVolume,  ///< A density.
};

/// Which values are inside: those below the isovalue or those above it.
enum class InsideValues { kLow, kHigh };

/// What a reading of a grid rests on.
enum class DecidedBy {
  kFile,    ///< The class that the grid carries.
  kType,    ///< Booleans are true inside.
  kValues,  ///< The values, where the grid has no class or contradicts it.
  kCaller,  ///< The options.
};

/// Where a grid may mean something else than what it was taken for, or its values are such that the surface suffers.
enum class GridDoubt {
  kPositiveInside,     ///< A level set whose background and outermost values are negative: they were taken as outside.
  kOutermostInside,    ///< The background is outside, but all outermost active values are inside.
  kSideUnclear,        ///< Neither the background nor the outermost values say which side is outside.
  kClassUnclear,       ///< Values of both signs that are no distances.
  kIsoGuessed,         ///< A fog volume without a class whose values are not between 0 and about 1, and no isovalue.
  kUnsigned,           ///< Distances without a sign: nothing is inside.
  kLooksLikeFog,       ///< The class says level set, but no value is negative.
  kLooksLikeLevelSet,  ///< The class says fog volume, but the values are signed distances.
  kNotFloodFilled,     ///< Inside, the active values end beside inactive ones that are outside: a false sheet.
  kCutAtEnd,           ///< A level set is inside where its values end, and closed there.
  kIsoNearBandEnd,     ///< The isovalue is less than a voxel from where the values end.
  kNarrowBand,         ///< The values end less than two voxels from the surface.
};

/// What to read a grid as; what is empty is decided from the grid.
struct GridMeaningOptions {
  std::optional<double> iso{};  ///< Finite.
  std::optional<GridClass> gridClass{};
  std::optional<InsideValues> inside{};
  /// See GridSourceOptions: values of weight 0 do not say what is outermost. Null if there is none.
  openvdb::GridBase::ConstPtr weight{};
  bool floodFill = false;  ///< See GridSourceOptions.
};

/// How a grid is read, and why.
struct GridMeaning {
  GridClass gridClass = GridClass::kLevelSet;
  DecidedBy classBy = DecidedBy::kFile;
  InsideValues inside = InsideValues::kLow;
  DecidedBy insideBy = DecidedBy::kFile;
  double iso = 0;  ///< In the grid's units.
  /// Median length of the gradient over some of the values, in the grid's units per world unit; 0 if it is not known.
  double slope = 0;
  /// How far from the surface a level set's values end, in voxels; 0 for other grids and where it is not known.
  double halfWidth = 0;
  double lowest = 0, highest = 0;  ///< The range of the values that were looked at.
  std::vector<GridDoubt> doubts;   ///< In the order of the enumeration.
};

/// A grid and how it is to be read.
struct ReadableGrid {
  /// The grid itself, or a copy of it whose background is outside, where the grid's own is not but should be, or whose
  /// inactive values were set by flood filling.
  openvdb::GridBase::ConstPtr grid;
  GridMeaning meaning;
  double clamp =
      0;  ///< Values this far from zero stand for all beyond, and carry no slope; infinite if there are none.
};

/// Decides what a grid's values mean.
///
/// The class is that of the options, or of the grid (level set or fog volume), or is decided by the values: a level set
/// where both signs occur and the gradient has the same length in most places, whatever its unit, or where neither sign
/// outweighs the other by far; a fog volume otherwise. The isovalue is 0 for level sets and 0.5 for fog volumes. Inside
/// is low in level sets and high in fog volumes. It is the other way around where neither the background nor any of the
/// outermost values are on the side that is outside then: for level sets with respect to zero, for fog volumes without
/// a class with respect to the isovalue. A background that is inside, while most of the outermost values are outside,
/// is taken as outside, on a copy of the grid. Outermost are the active values farthest along each axis.
///
/// Depends on nothing but the grid and the options. Looks at the outermost values and a sample of the others, at all
/// where there is no class. Runs in parallel on the calling thread's arena.
/// \throws std::invalid_argument for null; Error for value types that cannot be contoured and for transforms that are
/// singular.
[[nodiscard]] ReadableGrid readMeaning(const openvdb::GridBase::ConstPtr& grid, const GridMeaningOptions& options = {});

/// "level set" or "fog volume"; "low" or "high"; "file", "type", "values" or "caller".
[[nodiscard]] std::string_view nameOf(GridClass gridClass);
[[nodiscard]] std::string_view nameOf(InsideValues inside);
[[nodiscard]] std::string_view nameOf(DecidedBy by);

}  // namespace pdc
