#pragma once

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {

class CertifyHistory;

/// Moves suspect vertices on creases back towards where they are wanted, as far as their faces then have no conflict,
/// now that no other vertex moves any more. Those that bring each other conflicts return to where they were.
/// \param history null, or where to note the faces that changed. \throws Cancelled.
void restoreCreases(WorkingMesh& mesh, NearFaces& near, CertifyHistory* history = nullptr);

}  // namespace pdc::detail
