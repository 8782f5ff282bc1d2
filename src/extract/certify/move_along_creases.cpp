#include <algorithm>

#include "extract/certify/crease_moves.h"
#include "extract/certify/remedies.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {

std::vector<EdgeRef> moveAlongCreases(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict>& conflicts) {
  std::vector<std::size_t> moved;
  for (const VertexMove& m : findCreaseMoves(mesh, near, conflicts)) {
    mesh.restartAt(m.vertex, m.place);
    ++mesh.vertices()[m.vertex].creaseMoves;
    moved.push_back(m.vertex);
  }
  if (moved.empty()) return {};
  std::vector<EdgeRef> changed = mesh.quadsAt(moved);
  mesh.chooseSafeDiagonals(changed);
  std::vector<std::uint32_t> corners;
  for (const EdgeRef& e : changed)
    for (const std::uint32_t v : mesh.edgeCells().vertices(e)) corners.push_back(v);
  sortUnique(corners);
  std::erase_if(conflicts, [&](const Conflict& c) {
    mesh.monitor().throwIfStopped();
    bool waits = false;
    forEachCorner(c, [&](std::uint32_t v) { waits = waits || std::binary_search(corners.begin(), corners.end(), v); });
    if (waits) changed.insert(changed.end(), {c.edge0, c.edge1});
    return waits;
  });
  return changed;
}

}  // namespace pdc::detail
