#pragma once

#include <span>

#include "io/parse/parsed_mesh.h"

namespace pdc::detail {

/// Text or binary of either byte order; faces and strips of triangles. \param bytes whose line ends become '\n' where
/// they are text. \throws Error with a line's or an element's number; also for faces of a kind that is not read.
[[nodiscard]] ParsedMesh readPly(std::span<char> bytes, const Vec3d& shift);

}  // namespace pdc::detail
