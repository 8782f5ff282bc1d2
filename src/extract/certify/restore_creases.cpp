#include "extract/certify/restore_creases.h"

#include <algorithm>
#include <vector>

#include "extract/certify/certify_history.h"
#include "extract/certify/crease_moves.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {

void restoreCreases(WorkingMesh& mesh, NearFaces& near, CertifyHistory* history) {
  if (history != nullptr) history->beginPhase();
  std::vector<VertexMove> moves = findBetterPlaces(mesh, near);
  // From here on each move is the one that undoes it.
  std::vector<std::size_t> moved;
  const auto carryOut = [&](VertexMove& m) {
    const Vec3f before = mesh.vertices()[m.vertex].place;
    mesh.moveTo(m.vertex, m.place);
    m.place = before;
    moved.push_back(m.vertex);
  };
  std::for_each(moves.begin(), moves.end(), carryOut);
  while (!moved.empty()) {
    const std::vector<EdgeRef> faces = mesh.quadsAt(moved);
    if (history != nullptr) history->record(mesh, faces);
    std::vector<std::uint32_t> corners;
    for (const Conflict& c : near.findConflicts(faces))
      forEachCorner(c, [&](std::uint32_t v) { corners.push_back(v); });
    sortUnique(corners);
    const auto undone = std::stable_partition(moves.begin(), moves.end(), [&](const VertexMove& m) {
      return !std::binary_search(corners.begin(), corners.end(), mesh.vertices()[m.vertex].vertex);
    });
    moved.clear();
    std::for_each(undone, moves.end(), carryOut);
    moves.erase(undone, moves.end());
  }
}

}  // namespace pdc::detail
