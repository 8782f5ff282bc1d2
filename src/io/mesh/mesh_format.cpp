#include "io/mesh/mesh_format.h"

#include <fmt/format.h>

#include <string>

#include "io/file/file_error.h"
#include "io/file/suffix.h"

namespace pdc::detail {

MeshFormat meshFormat(const std::filesystem::path& path) {
  const std::string suffix = suffixOf(path);
  if (suffix == ".ply") return MeshFormat::kPly;
  if (suffix == ".obj") return MeshFormat::kObj;
  if (suffix == ".stl") return MeshFormat::kStl;
  if (suffix == ".off") return MeshFormat::kOff;
  throw fileError(path, fmt::format("\"{}\" is not the suffix of a mesh (.ply, .obj, .stl, .off)", suffix));
}

}  // namespace pdc::detail
