#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/mesh_file.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {

/// What `pdc info` says about a file: the grids of a .vdb, the box and lattice of a scene, or the report on a mesh
/// and the properties of its vertices.
/// \throws Error for files that cannot be read.
[[nodiscard]] nlohmann::ordered_json gatherFacts(const std::filesystem::path& path);

/// Facts about a mesh that has been read, without the file's name.
[[nodiscard]] nlohmann::ordered_json meshFileFacts(const MeshFile& file);

/// What the report on a mesh says, with its origin unless that is zero, and what the reader warned of.
[[nodiscard]] nlohmann::ordered_json meshFacts(const MeshFile& file, const MeshReport& report);

}  // namespace pdc
