#include "pdc/subdivide/infer_covariances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "parallel/block_progress.h"
#include "parallel/for_each_in_parallel.h"
#include "pdc/error.h"
#include "pdc/math/gaussian_product.h"
#include "pdc/math/solvers.h"
#include "pdc/mesh/vertex_covariances.h"

namespace pdc {
namespace {

constexpr std::size_t kGrain = 1024;

void checkOptions(const InferenceOptions& options) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (!positive(options.bias) || !positive(options.absoluteBias.value_or(1)))
    throw std::invalid_argument("inferCovariances: the bias must be finite and above 0");
  if (!positive(options.sigmaNormal))
    throw std::invalid_argument("inferCovariances: sigmaNormal must be finite and above 0");
}

/// The mean of (p − m)(p − m)ᵀ over points p with the mean m.
SymMat3<double> sampleCovariance(const std::vector<Vec3d>& points) {
  const double share = 1 / static_cast<double>(points.size());
  Vec3d offset{0, 0, 0};  // Relative to the first point, which loses nothing far from the origin.
  for (const Vec3d& p : points) offset += (p - points.front()) * share;
  SymMat3<double> sum = SymMat3<double>::zero();
  for (const Vec3d& p : points) sum += outer(p - points.front() - offset) * share;
  return sum;
}

/// With the bias; singular only where all points are in one place.
SymMat3<double> biased(const SymMat3<double>& covariance, const InferenceOptions& options) {
  return covariance.plusDiagonal(options.absoluteBias ? *options.absoluteBias
                                                      : options.bias * eigenSymmetric(covariance).value[0]);
}

SymMat3<double> ofFace(const Mesh& mesh, std::size_t f, const InferenceOptions& options) {
  std::vector<Vec3d> corners;
  for (const std::uint32_t v : detail::face(mesh, f)) corners.push_back(vecCast<double>(mesh.positions[v]));
  return biased(sampleCovariance(corners), options);
}

bool isDefinite(const SymMat3<double>& m) {
  const Eigen3 eigen = eigenSymmetric(m);
  return eigen.value[0] > 0 && eigen.value[2] >= kLeastEigenvalue * eigen.value[0];
}

/// The first of n things for which `holds` does not; n if there is none.
template <typename Holds>
std::size_t firstWhereNot(std::size_t n, const Holds& holds) {
  std::vector<std::uint8_t> right(n);
  detail::forEachInParallel(n, kGrain, [&](std::uint32_t i) { right[i] = holds(i); });
  return static_cast<std::size_t>(std::find(right.begin(), right.end(), std::uint8_t{0}) - right.begin());
}

Buffer<SymMat3<double>> fromFaces(const Mesh& mesh, const InferenceOptions& options, const Monitor& monitor) {
  const std::size_t faces = detail::faceCount(mesh);
  Buffer<SymMat3<double>> precision(faces);
  const std::size_t bad = firstWhereNot(faces, [&](std::uint32_t f) {
    const SymMat3<double> covariance = ofFace(mesh, f, options);
    const auto inverse = inversePositive(covariance);
    precision[f] = inverse.value_or(SymMat3<double>::identity());
    return inverse.has_value() && isDefinite(covariance);
  });
  if (bad < faces)
    throw Error(
        fmt::format("face {} has no covariance: its corners lie in one place, or the bias is less than {:g} of "
                    "its largest eigenvalue",
                    bad, kLeastEigenvalue));
  monitor.throwIfStopped();
  const detail::Connectivity connectivity(mesh);
  Buffer<SymMat3<double>> result(mesh.positions.size());
  detail::forEachInParallel(result.size(), kGrain, [&](std::uint32_t v) {
    SymMat3<double> sum = SymMat3<double>::zero();
    for (const detail::Corner& corner : connectivity.corners(v)) sum += precision[corner.face];
    result[v] = inversePositive(sum).value_or(SymMat3<double>::identity());
  });
  return result;
}

Buffer<SymMat3<double>> fromVertices(const Mesh& mesh, const InferenceOptions& options) {
  const detail::Connectivity connectivity(mesh);
  Buffer<SymMat3<double>> result(mesh.positions.size());
  const std::size_t bad = firstWhereNot(result.size(), [&](std::uint32_t v) {
    result[v] = SymMat3<double>::identity();
    if (connectivity.corners(v).empty()) return true;
    detail::OneRing ring;
    ring.look(connectivity, v);
    std::vector<Vec3d> points{vecCast<double>(mesh.positions[v])};
    ring.forEachEdge(
        [&](std::uint32_t other, const auto&) { points.push_back(vecCast<double>(mesh.positions[other])); });
    result[v] = biased(sampleCovariance(points), options);
    return isDefinite(result[v]);
  });
  if (bad < result.size())
    throw Error(
        fmt::format("vertex {} has no covariance: its neighbours lie in one place with it, or the bias is less "
                    "than {:g} of the largest eigenvalue",
                    bad, kLeastEigenvalue));
  return result;
}

/// Sum of the area vectors of the faces at a vertex, of any length.
Vec3d ringNormal(const Mesh& mesh, const detail::Connectivity& connectivity, std::uint32_t v) {
  Vec3d sum{0, 0, 0};
  for (const detail::Corner& corner : connectivity.corners(v)) {
    const auto named = detail::face(mesh, corner.face);
    const Vec3d p = vecCast<double>(mesh.positions[named[0]]);
    for (std::size_t k = 2; k < named.size(); ++k)
      sum += cross(vecCast<double>(mesh.positions[named[k - 1]]) - p, vecCast<double>(mesh.positions[named[k]]) - p);
  }
  return sum;
}

Buffer<SymMat3<double>> fromNormals(const Mesh& mesh, const InferenceOptions& options) {
  const double variance = options.sigmaNormal * options.sigmaNormal;
  if (!(variance >= kLeastEigenvalue))
    throw Error(fmt::format("sigma_n is {:g}; the limit is {:g}", options.sigmaNormal, std::sqrt(kLeastEigenvalue)));
  const detail::Connectivity connectivity(mesh);
  Buffer<SymMat3<double>> result(mesh.positions.size());
  detail::forEachInParallel(result.size(), kGrain, [&](std::uint32_t v) {
    Vec3d n = mesh.normals.empty() ? ringNormal(mesh, connectivity, v) : vecCast<double>(mesh.normals[v]);
    const double size = length(n);
    // Without a direction all of them are as likely.
    n = size > 0 && std::isfinite(size) ? n * (1 / size) : Vec3d{0, 0, 0};
    result[v] = inversePositive(outer(n).plusDiagonal(variance)).value_or(SymMat3<double>::identity());
  });
  return result;
}

}  // namespace

Buffer<SymMat3<double>> inferCovariances(const Mesh& mesh, const InferenceOptions& options, const Monitor& monitor) {
  detail::checkSizes(mesh, "inferCovariances", detail::FaceKinds::kAll);
  checkOptions(options);
  if (options.source == CovarianceSource::kProperties) return vertexCovariances(mesh, CovarianceKind::kDefinite);
  detail::checkIndices(mesh);
  detail::checkFinite(mesh);
  monitor.throwIfStopped();
  Buffer<SymMat3<double>> result;
  switch (options.source) {
    case CovarianceSource::kVertices:
      result = fromVertices(mesh, options);
      break;
    case CovarianceSource::kNormals:
      result = fromNormals(mesh, options);
      break;
    default:
      result = fromFaces(mesh, options, monitor);
  }
  monitor.throwIfStopped();
  return result;
}

}  // namespace pdc
