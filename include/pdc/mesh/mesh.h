#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "pdc/math/vec3.h"
#include "pdc/mesh/buffer.h"
#include "pdc/mesh/polygons.h"
#include "pdc/mesh/vertex_property.h"

namespace pdc {

using Quad = std::array<std::uint32_t, 4>;
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed surface: vertices, and faces of three kinds, any of which may be missing.
///
/// Positions are world coordinates less the origin, which is zero unless the mesh lies so far away that single
/// precision is too coarse there. Faces are counter-clockwise seen from outside. A quad (v0, v1, v2, v3) stands for the
/// triangles (v0, v1, v2) and (v0, v2, v3): its first corner fixes the diagonal.
///
/// A passive value that checks nothing itself. Every function that takes one throws
///
/// - std::invalid_argument for arrays that do not fit together: normals, or a property's numbers, that are not one for
///   each vertex; a property without a name, with another's name, or with less than 1 or more than 4 components;
///   polygons whose starts do not begin at 0 and ascend by three corners at least. Also for polygons, unless the
///   function's description speaks of them;
/// - Error for a face that names a vertex that does not exist.
///
/// Coordinates may be NaN or infinite and faces may name a vertex twice: each function says what it makes of those.
/// Several threads may read one mesh at a time.
struct Mesh {
  Buffer<Vec3f> positions;
  Vec3d origin{0, 0, 0};                   ///< What positions are relative to: world coordinates are origin + position.
  Buffer<Vec3f> normals;                   ///< Empty, or one unit vector per vertex.
  std::vector<VertexProperty> properties;  ///< What else is known of each vertex.
  Buffer<Quad> quads;
  Buffer<Triangle> triangles;
  Polygons polygons;  ///< Faces of any number of corners, as files have them; see triangulatePolygons().

  [[nodiscard]] bool empty() const { return quads.empty() && triangles.empty() && polygons.empty(); }

  /// The property of that name; null if there is none.
  [[nodiscard]] const VertexProperty* property(std::string_view name) const {
    const auto it =
        std::find_if(properties.begin(), properties.end(), [name](const auto& p) { return p.name == name; });
    return it == properties.end() ? nullptr : &*it;
  }
  /// Its numbers, those of a vector one after the other; empty if there is none of that name and type.
  template <typename Number>
  [[nodiscard]] std::span<const Number> values(std::string_view name) const {
    const VertexProperty* const found = property(name);
    const auto* const numbers = found == nullptr ? nullptr : std::get_if<Buffer<Number>>(&found->values);
    return numbers == nullptr ? std::span<const Number>() : std::span<const Number>(*numbers);
  }
};

}  // namespace pdc
