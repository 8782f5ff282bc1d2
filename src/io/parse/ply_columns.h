#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "io/parse/ply_header.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

// A .ply file knows single numbers: a vector "v" is the columns v_x, v_y, v_z and v_w, as many as it has components.

/// The columns of a property, by name.
[[nodiscard]] std::vector<std::string> plyColumnNames(const VertexProperty& property);

/// The type of a property's columns.
[[nodiscard]] PlyType plyType(const VertexProperty& property);

/// What the columns of a .ply file's vertices are besides positions and normals.
struct PlyColumns {
  static constexpr std::size_t kNoProperty = std::numeric_limits<std::size_t>::max();

  std::vector<VertexProperty> properties;  ///< Without values.
  std::vector<std::size_t> propertyOf;     ///< The place of each column's in `properties`, or kNoProperty.
};

/// Consecutive columns of one type that are named as plyColumnNames names those of a vector become one, unless its name
/// is taken. Lists and columns whose name has been there before are no properties.
[[nodiscard]] PlyColumns plyColumns(const std::vector<PlyProperty>& columns);

/// \throws std::invalid_argument if the names of the mesh's properties cannot stand in a .ply file: empty, with a blank
/// or a control character, or columns of one name, that of a position or a normal included.
void checkPlyNames(const Mesh& mesh);

}  // namespace pdc::detail
