#include "extract/fill_and_certify.h"

#include "extract/vertex_confidence.h"

namespace pdc::detail {

FilledMesh fillAndCertify(const Surface& surface, const ContourOptions& options, Mesh& mesh, const Monitor& monitor,
                          const CertifyNotes& notes) {
  const bool promised = options.placement != Placement::kFree;
  Suspects suspects;
  const SigmaNormal sigma =
      options.sigmaNormal ? SigmaNormal(*options.sigmaNormal) : SigmaNormal::fromData(surface.source);
  const FillMeshOptions fill{.sigma = sigma,
                             .halfSize = options.placement == Placement::kCell ? kCellHalfSize : kFreeHalfSize,
                             .normals = options.normals};
  FilledMesh result{.sigma = sigma, .counts = {}, .certified = {}};
  result.counts = fillMesh(surface, fill, mesh, promised ? &suspects : nullptr, monitor);
  if (promised) result.certified = certify(surface, suspects, mesh, monitor, notes);
  if (options.confidence || options.ranks) addVertexConfidence(surface, options, mesh, monitor);
  return result;
}

}  // namespace pdc::detail
