#pragma once

#include <cstddef>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

struct DroppedFaces {
  std::size_t folded = 0, duplicate = 0;
};

/// Drops faces until no two have the same vertices: pairs that face opposite ways cancel each other, and of what is
/// left the first stays. The others keep their order. \param faces that name three vertices.
DroppedFaces cleanFaces(Buffer<Triangle>& faces);

}  // namespace pdc::detail
