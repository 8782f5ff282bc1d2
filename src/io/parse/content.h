#pragma once

#include <optional>
#include <string_view>

namespace pdc::detail {

enum class MeshFormat { kPly, kObj, kStl, kOff };

/// "a PLY file", "an OBJ file", "an STL file", "an OFF file".
[[nodiscard]] std::string_view formatName(MeshFormat format);

/// The format of a mesh where the bytes leave no doubt.
[[nodiscard]] std::optional<MeshFormat> certainFormat(std::string_view bytes);

/// What bytes that are no mesh of ours seem to be, such as "a PNG picture"; empty if nothing is known.
[[nodiscard]] std::string_view otherContent(std::string_view bytes);

}  // namespace pdc::detail
