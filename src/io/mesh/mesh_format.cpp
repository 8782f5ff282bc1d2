#include "io/mesh/mesh_format.h"

#include <fmt/format.h>

#include <string>

#include "io/file/file_error.h"

namespace pdc::detail {

MeshFormat meshFormat(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (suffix == ".ply") return MeshFormat::kPly;
  if (suffix == ".obj") return MeshFormat::kObj;
  if (suffix == ".stl") return MeshFormat::kStl;
  if (suffix == ".off") return MeshFormat::kOff;
  throw fileError(path, fmt::format("\"{}\" is not the suffix of a mesh (.ply, .obj, .stl, .off)", suffix));
}

}  // namespace pdc::detail
