#include "pdc/io/mesh/mesh_writer.h"

#include <fmt/format.h>

#include <stdexcept>

#include "io/deflate/deflate_output.h"
#include "io/file/atomic_file.h"
#include "io/mesh/glb_writer.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/obj_writer.h"
#include "io/mesh/ply_writer.h"
#include "io/mesh/three_mf_writer.h"
#include "io/mesh/vtp_writer.h"
#include "io/openmesh/openmesh_writer.h"
#include "io/parse/origin_text.h"
#include "mesh/mesh_checks.h"
#include "pdc/mesh/triangulate_polygons.h"

namespace pdc {
namespace {

/// Calls write(mesh) with all faces as quads and triangles.
template <typename Write>
void withoutPolygons(const Mesh& mesh, const Write& write) {
  if (mesh.polygons.empty()) return write(mesh);
  Mesh triangulated = mesh;
  triangulatePolygons(triangulated);
  write(triangulated);
}

void writeAs(detail::OutputKind kind, const Mesh& mesh, detail::ByteOutput& out, const MeshWriteOptions& options) {
  using detail::OutputKind;
  switch (kind) {
    case OutputKind::kPly:
      return detail::writePly(mesh, out, options);
    case OutputKind::kObj:
      return detail::writeObj(mesh, out, options);
    case OutputKind::kStl:
      return withoutPolygons(mesh, [&](const Mesh& triangles) {
        detail::writeStl(triangles, out, options.ascii, detail::frameText(options.space, options.unit));
      });
    case OutputKind::kOff:
      return detail::writeOff(mesh, out, detail::frameText(options.space, options.unit));
    case OutputKind::kGlb:
      return withoutPolygons(mesh, [&](const Mesh& triangles) { detail::writeGlb(triangles, out, options); });
    case OutputKind::k3mf:
      return withoutPolygons(mesh, [&](const Mesh& triangles) { detail::writeThreeMf(triangles, out, options); });
    case OutputKind::kVtp:
      return detail::writeVtp(mesh, out, options);
  }
}

}  // namespace

void checkMeshPath(const std::filesystem::path& path) {
  static_cast<void>(detail::outputFormat(path));
  detail::checkWritable(path);
}

std::size_t writeMesh(const Mesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options) {
  detail::checkSizes(mesh, "writeMesh", detail::FaceKinds::kAll);
  const detail::OutputFormat format = detail::outputFormat(path);
  if (options.doublePrecision && !format.holdsDoubles())
    throw std::invalid_argument(
        fmt::format("writeMesh: only {} files hold double precision", detail::kFormatsWithDoubles));
  detail::checkIndices(mesh);
  detail::AtomicFile file(path);
  if (format.gzip) {
    detail::GzipOutput gzip(file);
    writeAs(format.kind, mesh, gzip, options);
    gzip.finish();
  } else {
    writeAs(format.kind, mesh, file, options);
  }
  file.commit();
  return file.bytesWritten();
}

}  // namespace pdc
