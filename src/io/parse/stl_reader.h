#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "io/parse/parsed_mesh.h"

namespace pdc::detail {

/// A binary file begins with a title and the number of its facets.
inline constexpr std::size_t kStlTitleBytes = 80, kStlHeaderBytes = 84;

/// A facet of a binary file: its normal, three corners and two bytes.
inline constexpr std::size_t kStlFacetBytes = 50;

/// Whether the bytes are as many as the facets announced in the header of a binary file take; there is one at least.
[[nodiscard]] bool isExactBinaryStl(std::string_view bytes);

/// Whether it is a text that begins with "solid" and has a line that begins with "facet" or "endsolid".
[[nodiscard]] bool isTextStl(std::string_view bytes);

/// Text or binary; vertices are welded. What follows the last facet is warned of. \param bytes of a text, whose line
/// ends become '\n', or of a binary file. \throws Error, of a text with the line's number.
[[nodiscard]] ParsedMesh readStl(std::span<char> bytes, const Vec3d& shift);

}  // namespace pdc::detail
