#pragma once

#include <filesystem>

#include "pdc/io/open_input.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Opens a mesh file that is to be contoured: see openInput(). Options that do not go with meshes have been refused.
[[nodiscard]] Input openMesh(const std::filesystem::path& path, const InputOptions& options, const Monitor& monitor);

/// The same of a mesh that has been read already. Keeps what it needs of it.
[[nodiscard]] Input openMesh(const Mesh& mesh, const InputOptions& options, const Monitor& monitor);

}  // namespace pdc::detail
