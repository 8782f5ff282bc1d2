#include "io/open_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mesh/faces.h"
#include "mesh/winding/closed_surface.h"
#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/field/mesh_field.h"
#include "pdc/field/operators.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/mesh/mesh_source.h"

namespace pdc::detail {
namespace {

constexpr double kMargin = 1.5;  // voxels

/// Relative to the mesh's origin.
Box boxOf(const Mesh& mesh) {
  Box box = Box::empty();
  for (std::size_t i = 0; i < faceCount(mesh); ++i)
    for (const std::uint32_t v : face(mesh, i))
      if (isFinite(mesh.positions[v])) box.include(vecCast<double>(mesh.positions[v]));
  return box;
}

double longestSide(const Mesh& mesh) {
  const Box box = boxOf(mesh);
  return box.isEmpty() ? 0 : std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
}

double voxelSizeFor(const Mesh& mesh, const InputOptions& options) {
  if (options.voxelSize) return *options.voxelSize;
  return longestSide(mesh) / options.resolution.value_or(kMeshResolution);
}

/// Whether distances to the mesh's triangles are those to the surface of its solid.
bool isSound(const Mesh& mesh, const Monitor& monitor) {
  const ClosedSurface closed = closeSurface(mesh, monitor);
  return closed.caps().empty() && selfIntersections(closed.surface, {.maxPairs = 0}, monitor).complete;
}

/// The mesh moved outwards, hollow, or both, by distances to it. One that is open or intersects itself is contoured
/// first.
Input openMoved(const Mesh& mesh, const MeshSource& plain, const InputOptions& options, const Monitor& monitor) {
  const double h = plain.map().voxelSize(), out = options.offset.value_or(0);
  if (!std::isfinite(out)) throw Error(fmt::format("an offset must be finite, not {}", out));
  if (options.shell && !(*options.shell > 0 && std::isfinite(*options.shell)))
    throw Error(fmt::format("the thickness of a shell must be positive and finite, not {}", *options.shell));
  Input input;
  const Mesh surface =
      isSound(mesh, monitor) ? mesh : contour(plain, {.sigmaNormal = kMeshSigmaNormal}, nullptr, monitor);
  if (surface.empty()) throw Error("the mesh has no solid to be moved: no winding number is above 1/2");
  FieldPtr field = meshField(surface);
  // The wall is centred half its thickness further in. That asks for each distance once, unlike a difference of two.
  field = options.shell ? shell(offset(field, out - *options.shell / 2), *options.shell) : offset(field, out);
  Box box = boxOf(surface);
  const double room = std::max(out, 0.0) + kMargin * h;
  box = {surface.origin + box.lo - Vec3d{room, room, room}, surface.origin + box.hi + Vec3d{room, room, room}};
  auto source = std::make_unique<FieldSource>(std::move(field), FieldSourceOptions{.box = box, .voxelSize = h});
  input.field = source->levelField();
  input.planeOrigin = PlaneOrigin::kFunction;
  input.whyEmpty = [] { return std::string("nothing is left of the mesh at this offset"); };
  input.source = std::move(source);
  return input;
}

}  // namespace

Input openMesh(const Mesh& mesh, const InputOptions& options, const Monitor& monitor) {
  if (mesh.empty()) throw Error("the mesh has no faces");
  const double voxelSize = voxelSizeFor(mesh, options);
  auto source = std::make_unique<MeshSource>(mesh, MeshSourceOptions{.voxelSize = voxelSize}, monitor);
  const MeshSourceFacts facts = source->facts();
  Input input;
  if (options.offset || options.shell) {
    input = openMoved(mesh, *source, options, monitor);
  } else {
    input.planeOrigin = PlaneOrigin::kTriangle;
    input.whyEmpty = [] { return std::string("no lattice point is inside: no winding number there is above 1/2"); };
    input.source = std::move(source);
    input.field = meshField(mesh);
  }
  input.sigmaNormal = kMeshSigmaNormal;
  input.mesh = {.triangles = facts.triangles, .openEdges = facts.openEdges, .voxelSize = voxelSize};
  return input;
}

Input openMesh(const std::filesystem::path& path, const InputOptions& options, const Monitor& monitor) {
  try {
    std::vector<std::string> warnings;
    const Mesh mesh = readMesh(path, {.warn = [&](const std::string& line) { warnings.push_back(line); }});
    Input input = openMesh(mesh, options, monitor);
    input.warnings.insert(input.warnings.begin(), warnings.begin(), warnings.end());
    return input;
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.find(path.string()) != std::string::npos) throw;
    throw Error(fmt::format("{}: {}", path.string(), what));
  }
}

}  // namespace pdc::detail
