#include <optional>

#include "io/scene/scene_shapes.h"
#include "pdc/field/grid_field.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc::detail {

FieldPtr readGridShape(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"file", "name", "iso"});
  GridSourceOptions options;
  if (p.has("iso")) options.iso = p["iso"].finiteNumber();
  const auto grid = readVdbGrid(context.folder / p["file"].text(), p.has("name") ? p["name"].text() : "");
  // GridSource chooses, so that a grid has the same inside and iso value here as on its own.
  const GridSource source(grid, options);
  return gridField(grid, source.iso(), source.insideIsHigher(), context.acceptNonFinite);
}

}  // namespace pdc::detail
