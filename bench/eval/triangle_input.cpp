#include "eval/triangle_input.h"

#include <stdexcept>

#include "pdc/extract/contour.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/open_input.h"

namespace pdc::eval {
namespace {

Mesh readOrContour(const std::filesystem::path& file) {
  if (inputKind(file) == InputKind::kMesh) return readMesh(file);
  const Input input = openInput(file);
  return contour(*input.source, {.sigmaNormal = input.sigmaNormal});
}

}  // namespace

Mesh readTriangles(const std::filesystem::path& file) {
  const Mesh read = readOrContour(file);
  Mesh mesh;
  mesh.positions = read.positions;
  mesh.origin = read.origin;
  for (const Quad& q : read.quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  mesh.triangles.insert(mesh.triangles.end(), read.triangles.begin(), read.triangles.end());
  if (mesh.triangles.empty()) throw std::runtime_error(file.string() + ": no faces");
  return mesh;
}

}  // namespace pdc::eval
