#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/ValueTransformer.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "pdc/error.h"
#include "pdc/sample/meaning/grid_meaning.h"
#include "sample/meaning/contourable_grids.h"
#include "sample/meaning/grid_map.h"
#include "sample/meaning/grid_meaning.h"

namespace pdc {
namespace {

std::optional<GridClass> classOf(const openvdb::GridBase& grid) {
  switch (grid.getGridClass()) {
    case openvdb::GRID_LEVEL_SET:
      return GridClass::kLevelSet;
    case openvdb::GRID_FOG_VOLUME:
      return GridClass::kFogVolume;
    default:
      return std::nullopt;
  }
}

/// Sets inactive values to what lies beyond the active ones that they are beside, `beyond` from zero.
template <typename GridT>
void floodFill(GridT& grid, double beyond, InsideValues inside) {
  using Value = typename GridT::ValueType;
  const auto width = static_cast<Value>(beyond);
  const auto negate = [&grid] {
    openvdb::tools::foreach (grid.beginValueAll(), [](const auto& value) { value.setValue(-*value); });
  };
  // OpenVDB fills what is negative inside.
  if (inside == InsideValues::kHigh) negate();
  openvdb::tools::signedFloodFillWithValues(grid.tree(), width, -width);
  if (inside == InsideValues::kLow) return;
  negate();
  grid.tree().root().setBackground(-width, /*updateChildNodes=*/false);
}

/// A copy whose background is another one. \param array see detail::Reading.
template <typename GridT>
typename GridT::Ptr withBackground(const GridT& grid, typename GridT::ValueType background, bool array) {
  if (!array) {
    auto copy = grid.deepCopy();
    openvdb::tools::changeBackground(copy->tree(), background);
    return copy;
  }
  auto copy = GridT::create(background);
  copy->fill(grid.evalActiveVoxelBoundingBox(), grid.background(), /*active=*/false);
  openvdb::tools::compReplace(copy->tree(), grid.tree());
  return copy;
}

/// A copy of the grid that is read instead.
openvdb::GridBase::ConstPtr repair(const openvdb::GridBase& grid, const detail::Reading& reading, bool fill) {
  openvdb::GridBase::Ptr repaired;
  detail::visitContourable(grid, [&](const auto& typed) {
    using Value = typename std::decay_t<decltype(typed)>::ValueType;
    if constexpr (!std::is_same_v<Value, bool>) {
      auto copy = reading.background ? withBackground(typed, static_cast<Value>(*reading.background), reading.array)
                                     : typed.deepCopy();
      if (fill) floodFill(*copy, reading.clamp, reading.meaning.inside);
      repaired = copy;
    }
  });
  repaired->setTransform(grid.transform().copy());
  repaired->setName(grid.getName());
  return repaired;
}

}  // namespace

ReadableGrid readMeaning(const openvdb::GridBase::ConstPtr& grid, const GridMeaningOptions& options) {
  if (!grid) throw std::invalid_argument("readMeaning: the grid is null");
  if (!detail::visitContourable(*grid, [](const auto&) {}))
    throw Error(
        fmt::format("grid of type {} cannot be contoured; {} can", grid->valueType(), detail::contourableTypeNames()));
  const std::optional<GridClass> fileClass = classOf(*grid);
  const auto known = options.gridClass ? options.gridClass : fileClass;
  const detail::GridEvidence evidence =
      detail::gatherEvidence(*grid, detail::gridMap(*grid), known, options.weight.get());
  const detail::Reading reading = detail::decideMeaning(evidence, fileClass, options);
  const bool fill = options.floodFill && reading.meaning.gridClass == GridClass::kLevelSet;
  if (options.floodFill && !(fill && std::isfinite(reading.clamp)))
    throw Error("only level sets whose values end in a band can be flood filled");
  return {reading.background || fill ? repair(*grid, reading, fill) : grid, reading.meaning, reading.clamp};
}

std::string_view nameOf(GridClass gridClass) { return gridClass == GridClass::kLevelSet ? "level set" : "fog volume"; }

std::string_view nameOf(InsideValues inside) { return inside == InsideValues::kLow ? "low" : "high"; }

std::string_view nameOf(DecidedBy by) {
  switch (by) {
    case DecidedBy::kFile:
      return "file";
    case DecidedBy::kType:
      return "type";
    case DecidedBy::kValues:
      return "values";
    case DecidedBy::kCaller:
      return "caller";
  }
  return "";
}

}  // namespace pdc
