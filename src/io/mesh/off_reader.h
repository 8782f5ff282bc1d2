#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// OFF as text, one vertex or face per line; normals (NOFF) are kept, colours and texture coordinates ignored.
/// \throws Error with the line's number
[[nodiscard]] Mesh readOff(std::string_view text);

}  // namespace pdc::detail
