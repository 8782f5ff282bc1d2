#include "eval/decimation_peers.h"

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
  };
}

std::vector<std::string> missingDecimationPeers() {
#ifdef PDC_HAVE_MESHOPTIMIZER
  return {};
#else
  return {"meshoptimizer"};
#endif
}

}  // namespace pdc::eval
