#pragma once

#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Text or binary of either byte order, numbers of any type. Normals and all properties of vertices that are not lists
/// are kept, other elements and the properties of faces skipped. \throws Error
[[nodiscard]] Mesh readPly(std::string_view bytes);

}  // namespace pdc::detail
