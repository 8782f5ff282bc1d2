#pragma once

#include "extract/certify/certify.h"
#include "extract/faces/fill_mesh.h"
#include "extract/topology/surface.h"
#include "pdc/extract/contour.h"

namespace pdc::detail {

/// What filling a mesh and certifying it counted, and the σn of its vertices.
struct FilledMesh {
  SigmaNormal sigma;
  VertexCounts counts;
  CertifyCounts certified;
};

/// Solves all vertices of a surface, writes its faces, certifies them where the placement promises that, and adds the
/// properties that are asked for. \param mesh empty but for its origin. \throws Cancelled, Error.
FilledMesh fillAndCertify(const Surface& surface, const ContourOptions& options, Mesh& mesh, const Monitor& monitor,
                          const CertifyNotes& notes = {});

}  // namespace pdc::detail
