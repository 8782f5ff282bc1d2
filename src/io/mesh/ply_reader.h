#pragma once

#include <optional>
#include <string_view>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Text or binary of either byte order, numbers of any type; normals are kept, other properties and elements skipped.
/// \throws Error
[[nodiscard]] Mesh readPly(std::string_view bytes);

/// The vertices' property of this name, one number each; empty if there is none or it is a list. \throws Error
[[nodiscard]] std::optional<Buffer<float>> readPlyProperty(std::string_view bytes, std::string_view name);

}  // namespace pdc::detail
