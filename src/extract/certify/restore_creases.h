#pragma once

#include "extract/certify/working_mesh.h"
#include "extract/conflicts/near_faces.h"

namespace pdc::detail {

/// Moves suspect vertices on creases back towards where they are wanted, as far as their faces then have no conflict,
/// now that no other vertex moves any more. Those that bring each other conflicts return to where they were.
/// \throws Cancelled.
void restoreCreases(WorkingMesh& mesh, NearFaces& near);

}  // namespace pdc::detail
