#pragma once

#include <vector>

#include "extract/certify/working_mesh.h"

namespace pdc::detail {

/// Finds the faces that meet in an ambiguous cell. Those whose vertices lie in their cells and whose diagonal passes
/// their lattice edge meet nowhere else (docs/soundness.md), so of these only pairs that share such a cell are tested,
/// and of those only pairs of different patches, or at one ambiguous face of the cell.
/// \param others all further faces, sorted; no pair with one of these is tested.
/// \returns both faces of each pair that meets; not sorted, and with repetitions. Runs in parallel. \throws Cancelled.
[[nodiscard]] std::vector<EdgeRef> facesMeetingInCells(const WorkingMesh& mesh, const std::vector<EdgeRef>& others);

}  // namespace pdc::detail
