#pragma once

#include <optional>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// Where the covariances of vertices come from (equations are those of Preiner et al. 2019).
enum class CovarianceSource {
  kFaces,     ///< The product of the Gaussians of the faces around (equations 16 and 17): keeps creases best.
  kVertices,  ///< The covariance of the vertex and its neighbours about their mean (equation 15).
  kNormals,  ///< (nnᵀ + σn²I)⁻¹: interpolation with probabilistic planes (Trettner & Kobbelt 2020, section 5.3).
  kProperties,  ///< The mesh's own: see vertex_covariances.h.
};

struct InferenceOptions {
  CovarianceSource source = CovarianceSource::kFaces;
  /// What is added to the diagonal of the covariance of a face, or of a vertex and its neighbours, which is flat
  /// otherwise: this share of its largest eigenvalue, above 0.
  double bias = 0.05;
  /// Replaces `bias` by what is added as such, in world units squared, σ0² of the paper; above 0.
  std::optional<double> absoluteBias{};
  /// Standard deviation of each component of the unit normals, above 0; for kNormals only.
  double sigmaNormal = 0.1;
};

/// The covariance of each vertex, in world units squared; of kNormals without a unit. All are positive definite as
/// CovarianceKind::kDefinite is. Vertices without faces have that of a point, the identity.
///
/// \param mesh any faces, polygons too; a manifold or not. Its normals are used by kNormals if it has any, else those
/// of the faces around weighted by area. \throws std::invalid_argument for options out of range and as Mesh says; Error
/// as Mesh says, for positions that are not finite, for a face whose corners lie in one place and a bias that is too
/// small beside a face, naming it; as vertexCovariances() does; Cancelled. The result does not depend on the number of
/// threads. No progress is reported.
[[nodiscard]] Buffer<SymMat3<double>> inferCovariances(const Mesh& mesh, const InferenceOptions& options = {},
                                                       const Monitor& monitor = {});

}  // namespace pdc
