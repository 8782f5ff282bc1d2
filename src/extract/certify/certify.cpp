#include "extract/certify/certify.h"

#include <array>

#include "extract/certify/ambiguous_cells.h"
#include "extract/certify/certify_history.h"
#include "extract/certify/remedies.h"
#include "extract/certify/restore_creases.h"
#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"
#include "extract/conflicts/round_progress.h"
#include "extract/vertices/cell_rounding.h"
#include "parallel/sort_unique.h"

namespace pdc::detail {
namespace {

/// Gentlest first.
constexpr std::array<Remedy*, 4> kRemedies{turnDiagonals, moveAlongCreases, retractVertices, subdivideFaces};

/// With one more nothing gets better.
constexpr int kRestorePasses = 2;

/// Tries the remedies on the conflicts, each on those that the ones before left. \returns the faces to be tested again,
/// sorted; appends those of conflicts that no remedy takes to `unresolved`.
std::vector<EdgeRef> resolve(WorkingMesh& mesh, NearFaces& near, std::vector<Conflict> conflicts,
                             std::vector<EdgeRef>& unresolved) {
  std::vector<EdgeRef> changed;
  for (Remedy* remedy : kRemedies) {
    const std::vector<EdgeRef> some = remedy(mesh, near, conflicts);
    changed.insert(changed.end(), some.begin(), some.end());
  }
  for (const Conflict& c : conflicts) unresolved.insert(unresolved.end(), {c.edge0, c.edge1});
  sortUnique(changed);
  return changed;
}

/// Numbers of the suspect vertices that lie outside of their cells; all where the map is not affine.
std::vector<std::size_t> outOfCell(const WorkingMesh& mesh) {
  const LatticeMap& map = mesh.faces().map();
  std::vector<std::size_t> out;
  std::int32_t block = -1;
  double halfSize = 0;
  for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
    const VertexState& v = mesh.vertices()[i];
    if (v.block != block) {
      block = v.block;
      halfSize = map.affine() ? roundedCellHalfSize(map, mesh.edgeCells().blockCoord(block)) : 0;
    }
    if (!(double{largestEntry(v.place)} <= halfSize)) out.push_back(i);
  }
  return out;
}

/// The faces that may have conflicts before anything has changed, sorted.
std::vector<EdgeRef> firstFaces(const WorkingMesh& mesh, const Suspects& suspects) {
  std::vector<EdgeRef> faces = mesh.quadsAt(outOfCell(mesh));
  for (const EdgeRef& e : suspects.quads)
    if (!mesh.fixed(e)) faces.push_back(e);
  sortUnique(faces);
  const std::vector<EdgeRef> meeting = facesMeetingInCells(mesh, faces);
  faces.insert(faces.end(), meeting.begin(), meeting.end());
  sortUnique(faces);
  return faces;
}

}  // namespace

CertifyCounts certify(const Surface& surface, const Suspects& suspects, Mesh& mesh, const Monitor& monitor,
                      const CertifyNotes& notes) {
  RoundProgress progress(monitor, "certify");
  WorkingMesh working(surface, suspects.vertices, mesh, monitor);
  working.chooseSafeDiagonals(suspects.quads);
  std::vector<EdgeRef> active = firstFaces(working, suspects);
  NearFaces near(working.faces(), progress);
  std::vector<EdgeRef> unresolved;
  if (notes.history != nullptr) notes.history->beginPhase();
  while (!active.empty()) {
    if (notes.history != nullptr) notes.history->record(working, active);
    active = resolve(working, near, near.findConflicts(active), unresolved);
  }
  for (int pass = 0; pass < kRestorePasses; ++pass) restoreCreases(working, near, notes.history);

  CertifyCounts counts;
  // What moved later may have resolved some of them.
  sortUnique(unresolved);
  counts.uncertified = near.findConflicts(unresolved).size();
  counts.forcedDiagonals = suspects.forcedDiagonals + working.turnCount();
  counts.fans = working.fans().size();
  for (const VertexState& v : working.vertices()) {
    const bool safe = v.place == v.safe;
    counts.drawnIn += safe;
    counts.shortened += !safe && v.place != v.wanted;
  }
  counts.addedBoundaryEdges = working.fans().replaceQuads(monitor, notes.fans);
  monitor.throwIfStopped();
  progress.finish();
  return counts;
}

}  // namespace pdc::detail
