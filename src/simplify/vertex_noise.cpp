#include "simplify/vertex_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/local/standard_deviations.h"
#include "pdc/error.h"
#include "pdc/mesh/vertex_covariances.h"

namespace pdc::detail {
namespace {

/// σn where a mesh has no noise: keeps vertices of flat parts apart. At 0.001 the faces of the fan disk come out 1.6
/// times as far from it, at 0.01 five times.
constexpr double kLeastSigma = 1e-4;

/// What noise of vertices does to the normals of their faces, in each component.
constexpr double kNormalNoise = 2;

/// The noise of normals at which the faces given have half of the say, and the share below which they have none, which
/// is faster.
constexpr double kHalfMemory = 0.5, kLeastMemory = 0.02;

/// The noise at which a face counts half. Where vertices have 0.2 to 0.5 on one side, 0.01 brings fewer triangles there
/// and lies nearer on both sides than 0.02 and 0.04; with less, what contouring says of the noise at clean creases, up
/// to 0.02, would make them count for little.
constexpr double kTrustedNoise = 0.01;

/// More noise than this counts as no more. Rounding stays far below what such faces count.
constexpr double kMostNoise = 100;

constexpr double square(double x) { return x * x; }

}  // namespace

NoiseChoice choiceFor(double noise, double fade) {
  const double normal = kNormalNoise * noise * noise * noise / (noise * noise + fade * fade);
  const double memory = normal / (normal + kHalfMemory);
  return {std::max(kLeastSigma, normal), std::max(kLeastSigma, normal / kNormalNoise),
          memory < kLeastMemory ? 0 : memory};
}

VertexNoise::VertexNoise(const Mesh& mesh, const std::string& property, double unit) {
  if (property == "cov" && hasVertexCovariances(mesh)) {
    readCovariances(mesh, unit);
  } else {
    readVariances(mesh, property, unit);
  }
  mCount.assign(mesh.positions.size(), 1);
}

void VertexNoise::readVariances(const Mesh& mesh, const std::string& property, double unit) {
  for (const double sigma : standardDeviations(mesh, property))
    mVariances.push_back(square(std::min(sigma / unit, kMostNoise)));
}

void VertexNoise::readCovariances(const Mesh& mesh, double unit) {
  for (const SymMat3<double>& given : vertexCovariances(mesh, CovarianceKind::kSemidefinite)) {
    // Divided twice, because the square of a tiny unit is 0.
    const SymMat3<double> scaled = given * (1 / unit) * (1 / unit);
    const double trace = scaled.trace(), most = 3 * square(kMostNoise);
    if (!std::isfinite(trace)) {
      mCovariances.push_back(SymMat3<double>::identity() * square(kMostNoise));
    } else {
      mCovariances.push_back(trace > most ? scaled * (most / trace) : scaled);
    }
  }
}

double VertexNoise::mean() const {
  double sum = 0;
  for (const double variance : mVariances) sum += std::sqrt(variance);
  for (const SymMat3<double>& covariance : mCovariances) sum += std::sqrt(std::max(0.0, covariance.trace() / 3));
  return mCount.empty() ? 0 : sum / static_cast<double>(mCount.size());
}

double VertexNoise::variance(std::uint32_t vertex, const Vec3d& direction) const {
  if (mCovariances.empty()) return mVariances[vertex];
  const double squared = dot(direction, direction);
  return squared > 0 ? std::max(0.0, quadraticForm(mCovariances[vertex], direction) / squared) : 0;
}

double VertexNoise::trust(const Triangle& face, const Vec3d& normal) const {
  const double sum = variance(face[0], normal) + variance(face[1], normal) + variance(face[2], normal);
  return square(kTrustedNoise) / (square(kTrustedNoise) + sum / 3);
}

NoiseChoice VertexNoise::choice(std::uint32_t vertex, const Vec3d& direction) const {
  return choiceFor(std::sqrt(variance(vertex, direction)), kFadeGiven);
}

void VertexNoise::merge(std::uint32_t a, std::uint32_t b) {
  const double share = static_cast<double>(mCount[b]) / (static_cast<double>(mCount[a]) + mCount[b]);
  if (mCovariances.empty()) {
    mVariances[a] = (1 - share) * mVariances[a] + share * mVariances[b];
  } else {
    mCovariances[a] = mCovariances[a] * (1 - share) + mCovariances[b] * share;
  }
  mCount[a] += mCount[b];
}

}  // namespace pdc::detail
