#include <fmt/format.h>

#include "io/scene/scene_shapes.h"
#include "pdc/field/mesh_field.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace pdc::detail {

FieldPtr readMeshShape(const YamlValue& parameters, SceneContext& context) {
  const YamlMap p(parameters, {"file"});
  const Mesh mesh = readMesh(context.folder / p["file"].text(),
                             {.warn = [&](const std::string& line) { context.warnings.push_back(line); }});
  return meshField(mesh);
}

}  // namespace pdc::detail
