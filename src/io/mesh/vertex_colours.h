#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Whether this is how .ply files name a component of a vertex's colour.
[[nodiscard]] inline bool isColour(std::string_view property) {
  return property == "red" || property == "green" || property == "blue";
}

/// Whether a mesh has colours as most .ply files have them: three properties of bytes.
[[nodiscard]] inline bool hasColours(const Mesh& mesh) {
  for (const char* const name : {"red", "green", "blue"}) {
    const VertexProperty* const property = mesh.property(name);
    if (property == nullptr || property->components != 1 ||
        !std::holds_alternative<Buffer<std::uint8_t>>(property->values))
      return false;
  }
  return true;
}

}  // namespace pdc::detail
