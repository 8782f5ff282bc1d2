#include "pdc/io/mesh/mesh_reader.h"

#include <new>
#include <string_view>

#include "io/file/file_error.h"
#include "io/file/read_file.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/off_reader.h"
#include "io/mesh/ply_reader.h"
#include "io/mesh/stl_reader.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc {
namespace {

Mesh parse(detail::MeshFormat format, std::string_view bytes) {
  switch (format) {
    case detail::MeshFormat::kPly:
      return detail::readPly(bytes);
    case detail::MeshFormat::kObj:
      return detail::readObj(bytes);
    case detail::MeshFormat::kStl:
      return detail::readStl(bytes);
    case detail::MeshFormat::kOff:
      break;
  }
  return detail::readOff(bytes);
}

}  // namespace

Mesh readMesh(const std::filesystem::path& path, const MeshReadOptions& options) {
  const detail::MeshFormat format = detail::meshFormat(path);
  try {
    const Buffer<char> bytes = detail::readFile(path);
    Mesh mesh = parse(format, {bytes.data(), bytes.size()});
    if (!options.keepPolygons) triangulatePolygons(mesh);
    return mesh;
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  } catch (const std::bad_alloc&) {
    throw detail::fileError(path, "does not fit into memory");
  }
}

}  // namespace pdc
