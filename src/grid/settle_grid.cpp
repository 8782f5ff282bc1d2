#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ValueTransformer.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "grid/real_grid.h"
#include "pdc/error.h"
#include "pdc/grid/grid_volume.h"

namespace pdc {
namespace {

/// What tools for level sets look at on each side of the surface, in voxels, less what rounding and half floats take.
constexpr double kLeastHalfWidth = 2.9;
/// Wider bands are dense distances, or have a background that is none; tools take long with them.
constexpr double kMostHalfWidth = 64;
/// Noise of 0.1 voxels makes slopes of 1.07; units other than the world's make others by far.
constexpr double kSlopeError = 0.3;
/// By how much the background may be another distance than the one where the values end, in voxels: tools take it as
/// the distance there.
constexpr double kBandError = 1;

template <typename GridT>
std::size_t countNonFinite(const GridT& grid) {
  std::atomic<std::size_t> count = 0;
  openvdb::tools::foreach (
      grid.cbeginValueAll(),
      [&count](const auto& value) {
        if (!std::isfinite(*value)) ++count;
      },
      /*threaded=*/true, /*shareFunctor=*/true);
  return count;
}

template <typename GridT>
void replaceNonFinite(GridT& grid, bool accept) {
  using Value = typename GridT::ValueType;
  const std::size_t count = countNonFinite(grid);
  if (count == 0 && std::isfinite(grid.background())) return;
  if (!accept)
    throw Error(fmt::format("{} values are NaN or infinite{}", count,
                            std::isfinite(grid.background()) ? ""
                                                             : ", and the "
                                                               "background is"));
  const Value background = std::isfinite(grid.background()) ? grid.background() : Value(0);
  openvdb::tools::foreach (grid.beginValueAll(), [background](const auto& value) {
    if (!std::isfinite(*value)) value.setValue(background);
  });
  grid.tree().root().setBackground(background, /*updateChildNodes=*/false);
}

template <typename GridT>
void negate(GridT& grid) {
  openvdb::tools::foreach (grid.beginValueAll(), [](const auto& value) { value.setValue(-*value); });
  grid.tree().root().setBackground(-grid.background(), /*updateChildNodes=*/false);
}

bool holdsDistances(const openvdb::GridBase& grid, const GridMeaning& meaning, double background) {
  if (meaning.gridClass != GridClass::kLevelSet || !grid.hasUniformVoxels()) return false;
  const double halfWidth = background / grid.voxelSize()[0];
  const bool bandEnds = meaning.halfWidth == 0 || std::abs(halfWidth - meaning.halfWidth) <= kBandError;
  return halfWidth >= kLeastHalfWidth && halfWidth <= kMostHalfWidth && bandEnds &&
         std::abs(meaning.slope - 1) <= kSlopeError;
}

}  // namespace

GridVolume settleGrid(openvdb::GridBase::Ptr grid, const SettleOptions& options, GridMeaning* meaning) {
  if (!grid) throw std::invalid_argument("settleGrid: the grid is null");
  if (!grid->isType<openvdb::FloatGrid>() && !grid->isType<openvdb::DoubleGrid>())
    throw Error(fmt::format("grid of type {} cannot be processed; float and double can", grid->valueType()));
  grid->apply<detail::RealGrids>([&](auto& typed) { replaceNonFinite(typed, options.acceptNonFinite); });
  const std::string name = grid->getName();
  const bool half = grid->saveFloatAsHalf();
  const ReadableGrid read = readMeaning(grid, options.meaning);
  GridVolume volume{.grid = openvdb::ConstPtrCast<openvdb::GridBase>(read.grid),
                    .gridClass = read.meaning.gridClass,
                    .inside = read.meaning.inside,
                    .iso = read.meaning.iso};
  const bool levelSet = volume.gridClass == GridClass::kLevelSet;
  double background = 0;
  detail::visitReal(volume, "settleGrid", [&](auto& typed) {
    if (levelSet && volume.inside == InsideValues::kHigh) {
      negate(typed);
      volume.inside = InsideValues::kLow;
      volume.iso = -volume.iso;
    }
    background = static_cast<double>(typed.background());
  });
  volume.grid->setName(name);
  volume.grid->setSaveFloatAsHalf(half);
  volume.grid->setGridClass(levelSet ? openvdb::GRID_LEVEL_SET : openvdb::GRID_FOG_VOLUME);
  volume.distances = holdsDistances(*volume.grid, read.meaning, background);
  if (meaning != nullptr) *meaning = read.meaning;
  return volume;
}

}  // namespace pdc
