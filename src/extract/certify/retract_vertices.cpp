#include <tbb/parallel_for.h>

#include "extract/certify/remedies.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {

std::vector<EdgeRef> retractVertices(WorkingMesh& mesh, NearFaces&, std::vector<Conflict>& conflicts) {
  std::vector<std::size_t> vertices;
  std::erase_if(conflicts, [&](const Conflict& c) {
    mesh.monitor().throwIfStopped();
    const std::size_t before = vertices.size();
    forEachCorner(c, [&](std::uint32_t v) {
      if (const std::ptrdiff_t i = mesh.movable(v); i >= 0) vertices.push_back(static_cast<std::size_t>(i));
    });
    return vertices.size() != before;
  });
  sortUnique(vertices);
  tbb::parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) { mesh.retract(vertices[i]); });
  std::vector<EdgeRef> changed = mesh.quadsAt(vertices);
  mesh.chooseSafeDiagonals(changed);
  return changed;
}

}  // namespace pdc::detail
