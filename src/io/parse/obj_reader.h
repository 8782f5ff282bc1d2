#pragma once

#include <span>

#include "io/parse/parsed_mesh.h"

namespace pdc::detail {

/// v, vn and f lines, keywords in any case, lines continued with a backslash. Texture, groups, materials, points and
/// lines are passed over; what else is not read is warned of. Normals are kept if every corner's normal has the number
/// of its vertex. \param text whose line ends become '\n'. \throws Error with the line's number; also if no line is
/// one of an OBJ file, and for surfaces without faces.
[[nodiscard]] ParsedMesh readObj(std::span<char> text, const Vec3d& shift);

}  // namespace pdc::detail
