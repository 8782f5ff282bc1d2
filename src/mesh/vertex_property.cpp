#include "pdc/mesh/vertex_property.h"

#include <array>

namespace pdc {

const char* typeName(const VertexProperty& property) {
  constexpr std::array kNames{"int8", "uint8", "int16", "uint16", "int32", "uint32", "float", "double"};
  static_assert(kNames.size() == std::variant_size_v<PropertyValues>);
  return kNames[property.values.index()];
}

}  // namespace pdc
