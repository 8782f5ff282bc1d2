#pragma once

#include "extract/topology/suspect_vertex.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Two triangles that meet where they should not; or, twice the same, one that is degenerate or faces backwards.
struct Conflict {
  EdgeRef edge0, edge1;  ///< Whose faces they belong to.
  Triangle triangle0, triangle1;
  friend auto operator<=>(const Conflict&, const Conflict&) = default;
};

/// Calls visit for each corner of a conflict's triangles.
template <typename Visit>
void forEachCorner(const Conflict& c, Visit&& visit) {
  for (const Triangle& t : {c.triangle0, c.triangle1})
    for (const std::uint32_t v : t) visit(v);
}

}  // namespace pdc::detail
