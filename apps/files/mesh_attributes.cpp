#include "files/mesh_attributes.h"

#include <fmt/format.h>

#include "io/mesh/mesh_format.h"
#include "io/mesh/vertex_colours.h"
#include "io/parse/ply_columns.h"
#include "pdc/error.h"
#include "pdc/sample/vdb/grid_attribute.h"

namespace pdc {

void checkAttributes(const Input& input, const std::vector<std::string>& taken) {
  std::set<std::string> names{"x", "y", "z", "nx", "ny", "nz"};
  names.insert(taken.begin(), taken.end());
  for (const InputAttribute& attribute : input.attributes)
    for (const VertexProperty& property : gridAttribute(*attribute.grid, attribute.name, {}))
      for (const std::string& column : detail::plyColumnNames(property))
        if (!names.insert(column).second)
          throw Error(fmt::format("the attribute '{}' would be a second property '{}' of the vertices", attribute.name,
                                  column));
}

void addAttributes(const Input& input, Mesh& mesh, const Monitor& monitor) {
  for (const InputAttribute& attribute : input.attributes)
    for (VertexProperty& property : gridAttribute(*attribute.grid, attribute.name, mesh, monitor))
      mesh.properties.push_back(std::move(property));
}

std::string lostProperties(const Mesh& mesh, const std::filesystem::path& path) {
  const detail::OutputFormat format = detail::outputFormat(path);
  const bool colours = format.kind == detail::OutputKind::kObj && detail::hasColours(mesh);
  std::string lost;
  for (const VertexProperty& property : mesh.properties) {
    if (format.holdsProperties() || (colours && detail::isColour(property.name))) continue;
    lost += (lost.empty() ? "" : ", ") + property.name;
  }
  return lost;
}

nlohmann::ordered_json propertiesJson(const std::vector<VertexProperty>& properties) {
  auto list = nlohmann::ordered_json::array();
  for (const VertexProperty& property : properties)
    list.push_back({{"name", property.name}, {"type", typeName(property)}, {"components", property.components}});
  return list;
}

}  // namespace pdc
