#include "extract/certify/remedies.h"

namespace pdc::detail {
namespace {

/// Makes fans of those of a conflict's faces that are quads. \returns whether there was one.
bool replaceByFans(WorkingMesh& mesh, const Conflict& c, std::vector<EdgeRef>& changed) {
  bool any = false;
  for (const EdgeRef& e : {c.edge0, c.edge1}) {
    if (mesh.fans().has(mesh.edgeCells().face(e))) continue;
    mesh.fans().add(e);
    changed.push_back(e);
    any = true;
  }
  return any;
}

/// Splits the ambiguous cells about a conflict's edges. \returns whether there was one left to split.
bool splitCells(WorkingMesh& mesh, const Conflict& c, std::vector<EdgeRef>& changed) {
  bool any = false;
  for (const EdgeRef& e : {c.edge0, c.edge1})
    for (const CellRef& cell : mesh.edgeCells().cells(e))
      if (kCellTable[mesh.edgeCells().code(cell)].ambiguous) any = mesh.fans().split(cell, changed) || any;
  return any;
}

}  // namespace

std::vector<EdgeRef> subdivideFaces(WorkingMesh& mesh, NearFaces&, std::vector<Conflict>& conflicts) {
  std::vector<EdgeRef> changed;
  std::erase_if(conflicts, [&](const Conflict& c) {
    mesh.monitor().throwIfStopped();
    return replaceByFans(mesh, c, changed) || splitCells(mesh, c, changed);
  });
  return changed;
}

}  // namespace pdc::detail
