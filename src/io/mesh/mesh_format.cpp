#include "io/mesh/mesh_format.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "io/file/file_error.h"
#include "io/file/suffix.h"

namespace pdc::detail {
namespace {

std::optional<OutputKind> kindOf(std::string_view suffix) {
  if (suffix == ".ply") return OutputKind::kPly;
  if (suffix == ".obj") return OutputKind::kObj;
  if (suffix == ".stl") return OutputKind::kStl;
  if (suffix == ".off") return OutputKind::kOff;
  if (suffix == ".glb") return OutputKind::kGlb;
  if (suffix == ".3mf") return OutputKind::k3mf;
  if (suffix == ".vtp") return OutputKind::kVtp;
  return std::nullopt;
}

}  // namespace

MeshFormat meshFormat(const std::filesystem::path& path) {
  const std::string suffix = suffixOf(path);
  switch (kindOf(suffix).value_or(OutputKind::kGlb)) {
    case OutputKind::kPly:
      return MeshFormat::kPly;
    case OutputKind::kObj:
      return MeshFormat::kObj;
    case OutputKind::kStl:
      return MeshFormat::kStl;
    case OutputKind::kOff:
      return MeshFormat::kOff;
    case OutputKind::kGlb:
    case OutputKind::k3mf:
    case OutputKind::kVtp:
      break;
  }
  throw fileError(path,
                  fmt::format("\"{}\" is not the suffix of a mesh that is read (.ply, .obj, .stl, .off)", suffix));
}

OutputFormat outputFormat(const std::filesystem::path& path) {
  std::string suffix = suffixOf(path);
  const bool gzip = suffix == ".gz";
  if (gzip) suffix = suffixOf(path.stem());
  const std::optional<OutputKind> kind = kindOf(suffix);
  const bool compressed = kind == OutputKind::kGlb || kind == OutputKind::k3mf || kind == OutputKind::kVtp;
  if (kind && !(gzip && compressed)) return {*kind, gzip};
  throw fileError(
      path, fmt::format("\"{}{}\" is not the suffix of a mesh that is written (.ply, .obj, .stl and .off, also with "
                        ".gz; .glb, .3mf, .vtp)",
                        suffix, gzip ? ".gz" : ""));
}

}  // namespace pdc::detail
