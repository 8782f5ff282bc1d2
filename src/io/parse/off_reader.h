#pragma once

#include <span>

#include "io/parse/parsed_mesh.h"

namespace pdc::detail {

/// OFF as text, one vertex or face per line, with or without a keyword, of any kind in three dimensions. Normals are
/// kept, colours and texture coordinates passed over, homogeneous coordinates divided. \param text whose line ends
/// become '\n'. \throws Error with the line's number
[[nodiscard]] ParsedMesh readOff(std::span<char> text, const Vec3d& shift);

}  // namespace pdc::detail
