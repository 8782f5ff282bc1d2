#include "pdc/io/mesh/mesh_writer.h"

#include <stdexcept>

#include "io/file/atomic_file.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/obj_writer.h"
#include "io/mesh/ply_writer.h"
#include "io/openmesh/openmesh_writer.h"
#include "io/parse/origin_text.h"
#include "mesh/mesh_checks.h"

namespace pdc {

void checkMeshPath(const std::filesystem::path& path) {
  static_cast<void>(detail::meshFormat(path));
  detail::checkWritable(path);
}

std::size_t writeMesh(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options) {
  detail::checkSizes(mesh, "writeMesh", detail::FaceKinds::kAll);
  const detail::MeshFormat format = detail::meshFormat(path);
  if (options.doublePrecision && format != detail::MeshFormat::kPly && format != detail::MeshFormat::kObj)
    throw std::invalid_argument("writeMesh: only .ply and .obj files hold double precision");
  detail::checkIndices(mesh);
  detail::AtomicFile file(path);
  switch (format) {
    case detail::MeshFormat::kPly:
      detail::writePly(mesh, file, options);
      break;
    case detail::MeshFormat::kObj:
      detail::writeObj(mesh, file, options);
      break;
    case detail::MeshFormat::kStl:
      detail::writeStl(mesh, file, options.ascii, detail::frameText(options.space, options.unit));
      break;
    case detail::MeshFormat::kOff:
      detail::writeOff(mesh, file, detail::frameText(options.space, options.unit));
      break;
  }
  file.commit();
  return file.bytesWritten();
}

}  // namespace pdc
