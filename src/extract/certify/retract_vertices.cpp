#include <tbb/parallel_for.h>

#include <algorithm>

#include "extract/certify/remedies.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {
namespace {

/// From so many corners of conflicting triangles on, a vertex that is on no known crease is folded by noise: then it
/// takes two steps at once.
constexpr std::ptrdiff_t kManyCorners = 6;

/// A suspect vertex by its number, and how many steps it takes.
struct Retraction {
  std::size_t vertex;
  int steps;
};

/// \param corners numbers of vertices, one for each corner of a conflicting triangle.
std::vector<Retraction> retractions(const WorkingMesh& mesh, std::vector<std::size_t>& corners) {
  std::sort(corners.begin(), corners.end());
  std::vector<Retraction> result;
  for (auto begin = corners.begin(); begin != corners.end();) {
    const auto end = std::find_if(begin, corners.end(), [&](std::size_t v) { return v != *begin; });
    const bool folded = end - begin >= kManyCorners && mesh.vertices()[*begin].creaseNormals[0] == Vec3f{};
    result.push_back({*begin, folded ? 2 : 1});
    begin = end;
  }
  return result;
}

}  // namespace

std::vector<EdgeRef> retractVertices(WorkingMesh& mesh, NearFaces&, std::vector<Conflict>& conflicts) {
  std::vector<std::size_t> corners;
  std::erase_if(conflicts, [&](const Conflict& c) {
    mesh.monitor().throwIfStopped();
    const std::size_t before = corners.size();
    forEachCorner(c, [&](std::uint32_t v) {
      if (const std::ptrdiff_t i = mesh.movable(v); i >= 0) corners.push_back(static_cast<std::size_t>(i));
    });
    return corners.size() != before;
  });
  const std::vector<Retraction> steps = retractions(mesh, corners);
  std::vector<std::size_t> vertices;
  for (const Retraction& r : steps) vertices.push_back(r.vertex);
  tbb::parallel_for(std::size_t{0}, steps.size(),
                    [&](std::size_t i) { mesh.retract(steps[i].vertex, steps[i].steps); });
  std::vector<EdgeRef> changed = mesh.quadsAt(vertices);
  mesh.chooseSafeDiagonals(changed);
  return changed;
}

}  // namespace pdc::detail
