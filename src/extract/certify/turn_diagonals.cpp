#include <algorithm>
#include <iterator>

#include "extract/certify/remedies.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {

std::vector<EdgeRef> turnDiagonals(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict>& conflicts) {
  std::vector<EdgeRef> edges;
  for (const Conflict& c : conflicts) {
    mesh.monitor().throwIfStopped();
    for (const EdgeRef& e : {c.edge0, c.edge1})
      if (!mesh.fans().has(mesh.edgeCells().face(e)) && !mesh.turnedBefore(e)) edges.push_back(e);
  }
  sortUnique(edges);
  // Where no vertex may move any more, the diagonal has been chosen for good.
  std::erase_if(edges, [&mesh](const EdgeRef& e) { return mesh.fixed(e); });
  std::vector<Quad> quads;
  for (const EdgeRef& e : edges) quads.push_back(mesh.turned(e));
  const std::vector<std::uint8_t> sound = near.soundWhenTurned(edges, quads);
  std::vector<EdgeRef> turned;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (sound[i] != 0) turned.push_back(edges[i]);
  mesh.turn(turned);
  std::erase_if(conflicts, [&turned](const Conflict& c) {
    return std::binary_search(turned.begin(), turned.end(), c.edge0) ||
           std::binary_search(turned.begin(), turned.end(), c.edge1);
  });
  return turned;
}

}  // namespace pdc::detail
