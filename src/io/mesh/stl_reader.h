#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Binary STL, recognised by its size, or text. Corners at the same position become one vertex, numbered in the order
/// of appearance; 0 and -0 are the same, NaN equals only itself, bit by bit. \throws Error
[[nodiscard]] Mesh readStl(std::string_view bytes);

}  // namespace pdc::detail
