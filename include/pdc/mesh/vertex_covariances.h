#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/mesh.h"

namespace pdc {

/// The properties, of one number each, that hold the covariance of each vertex, in world units squared. A mesh that has
/// them is a covariance mesh (Preiner et al. 2019). Six entries are symmetric by construction.
inline constexpr std::array<const char*, 6> kCovarianceNames{"covxx", "covxy", "covxz", "covyy", "covyz", "covzz"};

/// Which covariances are right. Either way they are finite.
enum class CovarianceKind {
  kSemidefinite,  ///< No eigenvalue is below 0 by more than single precision explains.
  kDefinite,      ///< The least eigenvalue is at least kLeastEigenvalue of the largest, which is above 0.
};

/// Flatter covariances than this lose too many digits in double precision where they are inverted.
inline constexpr double kLeastEigenvalue = 1e-12;

/// Whether there are any: whether the vertices have the first of the properties.
[[nodiscard]] bool hasVertexCovariances(const Mesh& mesh);

/// The covariance of each vertex. \throws Error that names the property that is missing or has several numbers, or the
/// first vertex with a covariance that is none; std::invalid_argument as Mesh says, polygons allowed.
[[nodiscard]] Buffer<SymMat3<double>> vertexCovariances(const Mesh& mesh, CovarianceKind kind);

/// Gives each vertex its covariance, in double precision, in place of what it had. \throws std::invalid_argument unless
/// there is one for each vertex.
void setVertexCovariances(Mesh& mesh, std::span<const SymMat3<double>> covariances);

/// What the covariances of a mesh are like.
struct CovarianceReport {
  std::size_t definite = 0;  ///< Vertices whose covariance is positive definite, as CovarianceKind has it.
  std::optional<std::size_t> firstOther{};  ///< The first vertex whose is not.
  double leastEigenvalue = 0,
         largestEigenvalue = 0;  ///< Of those vertices that have a finite one; world units squared.
};

/// \throws as vertexCovariances() does for properties; covariances that are none are counted.
[[nodiscard]] CovarianceReport analyzeCovariances(const Mesh& mesh);

}  // namespace pdc
