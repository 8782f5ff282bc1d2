#include "files/mesh_file.h"

#include "pdc/io/mesh/mesh_reader.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/warning.h"

namespace pdc {

MeshFile readMeshFile(const std::filesystem::path& path, bool quiet, bool keepPolygons) {
  MeshFile file;
  const auto warn = [&](const std::string& warning) {
    file.warnings.push_back(warning);
    if (!quiet) printWarning(warning);
  };
  file.mesh = readMesh(path, {.keepPolygons = keepPolygons, .warn = warn});
  return file;
}

std::size_t writeMeshFile(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                          bool quiet) {
  const ExitOnInterrupt scope;
  const BusySign sign(!quiet, "writing " + path.filename().string());
  return writeMesh(mesh, path, options);
}

}  // namespace pdc
