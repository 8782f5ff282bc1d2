#include "mesh/mesh_checks.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

#include "mesh/faces.h"
#include "pdc/error.h"

namespace pdc::detail {

namespace {

/// Whether the first polygon begins at 0 and each one three corners or more before the next one and the end.
bool areStartsRight(const Polygons& polygons) {
  const auto& [corners, starts] = polygons;
  if (starts.empty()) return corners.empty();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : corners.size();
    if (end < starts[i] || end - starts[i] < 3) return false;
  }
  return starts.front() == 0;
}

}  // namespace

void checkSizes(const Mesh& mesh, const char* caller, FaceKinds faces) {
  const auto refuse = [caller](const std::string& what) {
    throw std::invalid_argument(fmt::format("{}: {}", caller, what));
  };
  if (!areStartsRight(mesh.polygons)) refuse("polygons must begin at 0 and have three corners at least");
  if (faces == FaceKinds::kTrianglesAndQuads && !mesh.polygons.empty())
    refuse(fmt::format("{} polygons, must be triangles and quads; see triangulatePolygons", mesh.polygons.size()));
  const std::size_t vertices = mesh.positions.size();
  if (!mesh.normals.empty() && mesh.normals.size() != vertices)
    refuse(fmt::format("{} normals for {} vertices", mesh.normals.size(), vertices));
  for (const VertexProperty& property : mesh.properties) {
    const auto& [name, components, values] = property;
    if (name.empty()) refuse("a property without a name");
    if (mesh.property(name) != &property) refuse(fmt::format("two properties \"{}\"", name));
    if (components < 1 || components > 4)
      refuse(fmt::format("property \"{}\" has {} components, must be 1 to 4", name, components));
    const std::size_t numbers = std::visit([](const auto& v) { return v.size(); }, values);
    if (numbers != vertices * static_cast<std::size_t>(components))
      refuse(fmt::format("property \"{}\" has {} numbers for {} vertices of {} components", name, numbers, vertices,
                         components));
  }
}

void checkIndices(const Mesh& mesh) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t kGrain = 4096;
  const std::size_t vertices = mesh.positions.size();
  const std::size_t first = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, faceCount(mesh), kGrain), kNone,
      [&](const tbb::blocked_range<std::size_t>& range, std::size_t found) {
        for (std::size_t i = range.begin(); i != range.end() && found == kNone; ++i)
          for (const std::uint32_t v : face(mesh, i))
            if (v >= vertices) found = i;
        return found;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (first == kNone) return;
  const auto named = face(mesh, first);
  throw Error(fmt::format("face {} names vertex {}, but the mesh has {} vertices", first,
                          *std::max_element(named.begin(), named.end()), vertices));
}

void checkFinite(const Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (!isFinite(mesh.positions[v])) throw Error(fmt::format("vertex {} has a coordinate that is not finite", v));
}

std::vector<double> scalarNumbers(const Mesh& mesh, const std::string& name) {
  const VertexProperty* const property = mesh.property(name);
  if (property == nullptr) throw Error(fmt::format("the vertices have no property '{}'", name));
  if (property->components != 1)
    throw Error(fmt::format("the property '{}' has {} numbers per vertex, not 1", name, property->components));
  return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                    property->values);
}

}  // namespace pdc::detail
