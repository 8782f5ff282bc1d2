#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// v, vn and f lines; all others are ignored. Normals are kept if every corner's normal has the number of its vertex.
/// \throws Error with the line's number
[[nodiscard]] Mesh readObj(std::string_view text);

}  // namespace pdc::detail
