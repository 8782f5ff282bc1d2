#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "pdc/mesh/buffer.h"

namespace pdc {

/// Numbers of one of the eight types that .ply files know.
using PropertyValues =
    std::variant<Buffer<std::int8_t>, Buffer<std::uint8_t>, Buffer<std::int16_t>, Buffer<std::uint16_t>,
                 Buffer<std::int32_t>, Buffer<std::uint32_t>, Buffer<float>, Buffer<double>>;

/// A named number or vector at each vertex of a mesh. Any name will do for the library; .ply files hold those without
/// blanks and control characters (see writeMesh).
struct VertexProperty {
  std::string name;         ///< Not empty, and no other property of the mesh has it.
  int components = 1;       ///< 1 to 4 numbers per vertex.
  PropertyValues values{};  ///< Those of vertex i are number i * components to (i + 1) * components - 1.

  friend bool operator==(const VertexProperty&, const VertexProperty&) = default;
};

/// "int8", "uint8", "int16", "uint16", "int32", "uint32", "float" or "double".
[[nodiscard]] const char* typeName(const VertexProperty& property);

}  // namespace pdc
