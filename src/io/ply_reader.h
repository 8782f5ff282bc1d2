#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Text or binary of either byte order, numbers of any type; normals are kept, other properties and elements skipped.
/// \throws Error
[[nodiscard]] Mesh readPly(std::string_view bytes);

}  // namespace pdc::detail
