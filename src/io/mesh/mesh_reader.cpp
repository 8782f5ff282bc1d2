#include "pdc/io/mesh/mesh_reader.h"

#include <fmt/format.h>

#include <new>
#include <span>
#include <string_view>

#include "io/deflate/inflate.h"
#include "io/file/file_error.h"
#include "io/file/line_ends.h"
#include "io/file/read_file.h"
#include "io/file/suffix.h"
#include "io/mesh/mesh_format.h"
#include "io/parse/obj_reader.h"
#include "io/parse/off_reader.h"
#include "io/parse/ply_reader.h"
#include "io/parse/stl_reader.h"
#include "mesh/polygons/concave_quads.h"
#include "parallel/machine_memory.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc {
namespace {

using detail::MeshFormat;
using detail::ParsedMesh;

ParsedMesh parse(MeshFormat format, std::span<char> bytes, const Vec3d& shift) {
  switch (format) {
    case MeshFormat::kPly:
      return detail::readPly(bytes, shift);
    case MeshFormat::kObj:
      return detail::readObj(bytes, shift);
    case MeshFormat::kStl:
      return detail::readStl(bytes, shift);
    case MeshFormat::kOff:
      break;
  }
  return detail::readOff(bytes, shift);
}

/// The format of the content where that is certain, or what the suffix says.
MeshFormat formatOf(std::string_view bytes, MeshFormat named, const std::function<void(const std::string&)>& warn) {
  const auto certain = detail::certainFormat(bytes);
  if (!certain) {
    const std::string_view other = detail::otherContent(bytes);
    if (!other.empty()) throw Error(fmt::format("not {}: it seems to be {}", formatName(named), other));
    constexpr std::size_t kLooked = 1024;
    if (named != MeshFormat::kStl && bytes.substr(0, kLooked).find('\0') != std::string_view::npos)
      throw Error(fmt::format("not {}: it is binary", formatName(named)));
    return named;
  }
  if (*certain != named)
    warn(fmt::format("{} by its suffix, but {} by its content, and read as that", formatName(named),
                     formatName(*certain)));
  return *certain;
}

ParsedMesh read(Buffer<char>& bytes, MeshFormat named, const std::function<void(const std::string&)>& warn) {
  std::span<char> rest(bytes);
  const std::string_view all(rest.data(), rest.size());
  if (all.starts_with(detail::kByteOrderMark) && !detail::isExactBinaryStl(all))
    rest = rest.subspan(detail::kByteOrderMark.size());
  const MeshFormat format = formatOf({rest.data(), rest.size()}, named, warn);
  ParsedMesh parsed = parse(format, rest, {0, 0, 0});
  const Vec3d shift = detail::chooseOrigin(parsed.narrowing);
  if (shift != Vec3d{0, 0, 0}) parsed = parse(format, rest, shift);
  for (const std::string& warning : parsed.warnings) warn(warning);
  return parsed;
}

}  // namespace

Mesh readMesh(const std::filesystem::path& path, const MeshReadOptions& options) {
  const bool deflated = detail::suffixOf(path) == ".gz";
  const MeshFormat named = detail::meshFormat(deflated ? path.parent_path() / path.stem() : path);
  const auto warn = [&](const std::string& what) {
    if (options.warn) options.warn(detail::fileError(path, what).what());
  };
  try {
    Buffer<char> bytes = detail::readFile(path);
    if (deflated) bytes = detail::inflateAll(bytes);
    ParsedMesh parsed = read(bytes, named, warn);
    if (!parsed.splitsQuads) detail::turnConcaveQuads(parsed.mesh);
    if (!options.keepPolygons) triangulatePolygons(parsed.mesh);
    return std::move(parsed.mesh);
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  } catch (const std::bad_alloc&) {
    throw detail::fileError(path, "does not fit into memory: " + detail::memoryFigures());
  }
}

}  // namespace pdc
