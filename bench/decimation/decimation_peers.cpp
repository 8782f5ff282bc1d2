#include "decimation/decimation_peers.h"

namespace pdc::eval {

std::vector<DecimationPeer> decimationPeers() {
  return {
      {"CGAL planes", cgalPlanes},
      {"CGAL probabilistic planes", cgalProbabilisticPlanes},
      {"CGAL Lindstrom-Turk", cgalLindstromTurk},
      {"OpenMesh quadrics", openMeshQuadrics},
#ifdef PDC_HAVE_MESHOPTIMIZER
      {"meshoptimizer", meshoptSimplify},
#endif
#ifdef PDC_HAVE_VTK
      {"VTK quadrics", vtkQuadrics},
      {"VTK DecimatePro", vtkPro},
#endif
  };
}

std::vector<std::string> missingDecimationPeers() {
  std::vector<std::string> missing;
#ifndef PDC_HAVE_MESHOPTIMIZER
  missing.emplace_back("meshoptimizer");
#endif
#ifndef PDC_HAVE_VTK
  missing.emplace_back("VTK");
#endif
  return missing;
}

}  // namespace pdc::eval
