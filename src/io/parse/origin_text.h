#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pdc/math/vec3.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

// A mesh's origin stands in its file as the text "pdc_origin X Y Z": a comment in .ply, .obj and .off, and part of the
// header or the first line of .stl.

/// The comment in .ply, .obj and .off files that says that we wrote them, and that their quads are split as ours are.
inline constexpr std::string_view kOwnComment = "pdc";

/// The text, in the shortest decimals that read back.
[[nodiscard]] std::string originText(const Vec3d& origin);

/// A comment's line with the mesh's origin; empty if that is zero. \param mark begins a comment.
[[nodiscard]] std::string originLine(const Mesh& mesh, std::string_view mark);

/// The origin that a comment, without the sign of a comment, says; nothing if it is about something else.
[[nodiscard]] std::optional<Vec3d> originInComment(std::string_view comment);

/// Takes an origin that a file says. \throws Error if another one was found before.
void takeOrigin(const Vec3d& origin, std::optional<Vec3d>& found);

/// The origin that a line of a text beginning with '#' says. \throws Error if two lines say different ones.
[[nodiscard]] std::optional<Vec3d> originInText(std::string_view text);

/// The origin that stands anywhere in a header.
[[nodiscard]] std::optional<Vec3d> originInHeader(std::string_view header);

/// "SPACE=RAS UNIT=mm", as 3D Slicer looks for it in the first lines of meshes: what is known of the frame that
/// coordinates are in and of their unit; empty if nothing is. Has no blanks but that between the two.
[[nodiscard]] std::string frameText(std::string_view space, std::string_view unit);

/// A comment's line with `text`; empty if that is.
[[nodiscard]] std::string commentLine(std::string_view text, std::string_view mark);

}  // namespace pdc::detail
