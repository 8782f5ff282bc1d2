#include <fmt/format.h>

#include "io/scene/scene_shapes.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/field/grid_field.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/meaning/grid_meaning.h"

namespace pdc::detail {
namespace {

template <typename Value>
Value oneOf(const YamlValue& value, std::string_view first, Value ifFirst, std::string_view second, Value ifSecond) {
  const std::string text = value.text();
  if (text != first && text != second) value.failNot(fmt::format("{} or {}", first, second));
  return text == first ? ifFirst : ifSecond;
}

}  // namespace

FieldPtr readGridShape(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"file", "name", "iso", "class", "inside"});
  GridMeaningOptions options;
  if (p.has("iso")) options.iso = p["iso"].finiteNumber();
  if (p.has("class"))
    options.gridClass = oneOf(p["class"], "level-set", GridClass::kLevelSet, "fog", GridClass::kFogVolume);
  if (p.has("inside")) options.inside = oneOf(p["inside"], "low", InsideValues::kLow, "high", InsideValues::kHigh);
  const auto grid = readVdbGrid(context.folder / p["file"].text(), p.has("name") ? p["name"].text() : "");
  const ReadableGrid readable = readMeaning(grid, options);
  for (const std::string& line : gridWarnings(readable.meaning, OptionStyle::kScene))
    context.warnings.push_back(fmt::format("grid \"{}\": {}", grid->getName(), line));
  return gridField(readable.grid, readable.meaning.iso, readable.meaning.inside == InsideValues::kHigh,
                   context.acceptNonFinite);
}

}  // namespace pdc::detail
