#pragma once

#include <filesystem>

#include "pdc/mesh/mesh.h"

namespace pdc::eval {

/// A mesh file, or the contour of a grid or scene, with the triangles that its quads stand for, and nothing but those.
/// \throws std::runtime_error if there are none.
[[nodiscard]] Mesh readTriangles(const std::filesystem::path& file);

}  // namespace pdc::eval
