#include "pdc/mesh/vertex_covariances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_checks.h"
#include "pdc/error.h"
#include "pdc/math/solvers.h"

namespace pdc {
namespace {

/// Covariances in single precision may have eigenvalues so far below 0, as a share of the trace.
constexpr double kNegativeShare = 1e-5;

bool isFinite(const SymMat3<double>& m) {
  return std::isfinite(m.xx) && std::isfinite(m.xy) && std::isfinite(m.xz) && std::isfinite(m.yy) &&
         std::isfinite(m.yz) && std::isfinite(m.zz);
}

bool isDefinite(const Eigen3& eigen) {
  return eigen.value[0] > 0 && eigen.value[2] >= kLeastEigenvalue * eigen.value[0];
}

/// Unchecked.
Buffer<SymMat3<double>> numbersOfCovariances(const Mesh& mesh) {
  std::array<std::vector<double>, 6> entries;
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = detail::scalarNumbers(mesh, kCovarianceNames[i]);
  const auto& [xx, xy, xz, yy, yz, zz] = entries;
  Buffer<SymMat3<double>> covariances(mesh.positions.size());
  for (std::size_t v = 0; v < covariances.size(); ++v) covariances[v] = {xx[v], xy[v], xz[v], yy[v], yz[v], zz[v]};
  return covariances;
}

void check(const SymMat3<double>& covariance, std::size_t vertex, CovarianceKind kind) {
  if (!isFinite(covariance)) throw Error(fmt::format("the covariance of vertex {} is not finite", vertex));
  const Eigen3 eigen = eigenSymmetric(covariance);
  const double least = eigen.value[2];
  if (!(least >= -kNegativeShare * std::abs(covariance.trace())) || (kind == CovarianceKind::kDefinite && least < 0))
    throw Error(fmt::format("the covariance of vertex {} has the eigenvalue {:.4g}; the limit is 0", vertex, least));
  if (kind == CovarianceKind::kDefinite && !isDefinite(eigen))
    throw Error(
        fmt::format("the covariance of vertex {} has the eigenvalues {:.4g} and {:.4g}; it must be positive "
                    "definite, and the limit is {:g} of the largest",
                    vertex, least, eigen.value[0], kLeastEigenvalue));
}

}  // namespace

bool hasVertexCovariances(const Mesh& mesh) { return mesh.property(kCovarianceNames[0]) != nullptr; }

Buffer<SymMat3<double>> vertexCovariances(const Mesh& mesh, CovarianceKind kind) {
  detail::checkSizes(mesh, "vertexCovariances", detail::FaceKinds::kAll);
  Buffer<SymMat3<double>> covariances = numbersOfCovariances(mesh);
  for (std::size_t v = 0; v < covariances.size(); ++v) check(covariances[v], v, kind);
  return covariances;
}

void setVertexCovariances(Mesh& mesh, std::span<const SymMat3<double>> covariances) {
  if (covariances.size() != mesh.positions.size())
    throw std::invalid_argument(
        fmt::format("setVertexCovariances: {} covariances for {} vertices", covariances.size(), mesh.positions.size()));
  std::erase_if(mesh.properties, [](const VertexProperty& property) {
    return std::find(kCovarianceNames.begin(), kCovarianceNames.end(), property.name) != kCovarianceNames.end();
  });
  constexpr std::array kEntries{&SymMat3<double>::xx, &SymMat3<double>::xy, &SymMat3<double>::xz,
                                &SymMat3<double>::yy, &SymMat3<double>::yz, &SymMat3<double>::zz};
  for (std::size_t i = 0; i < kEntries.size(); ++i) {
    Buffer<double> numbers(covariances.size());
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = covariances[v].*kEntries[i];
    mesh.properties.push_back({kCovarianceNames[i], 1, std::move(numbers)});
  }
}

CovarianceReport analyzeCovariances(const Mesh& mesh) {
  detail::checkSizes(mesh, "analyzeCovariances", detail::FaceKinds::kAll);
  CovarianceReport report;
  const Buffer<SymMat3<double>> covariances = numbersOfCovariances(mesh);
  bool first = true;
  for (std::size_t v = 0; v < covariances.size(); ++v) {
    const bool finite = isFinite(covariances[v]);
    const Eigen3 eigen = finite ? eigenSymmetric(covariances[v]) : Eigen3{};
    if (finite && isDefinite(eigen)) {
      ++report.definite;
    } else if (!report.firstOther) {
      report.firstOther = v;
    }
    if (!finite) continue;
    report.leastEigenvalue = first ? eigen.value[2] : std::min(report.leastEigenvalue, eigen.value[2]);
    report.largestEigenvalue = first ? eigen.value[0] : std::max(report.largestEigenvalue, eigen.value[0]);
    first = false;
  }
  return report;
}

}  // namespace pdc
