#include "extract/vertices/vertex_solver.h"

#include <algorithm>
#include <cmath>

#include "pdc/math/solvers.h"

namespace pdc::detail {
namespace {

/// Eigenvalues of the classical quadric below this share of the largest count as zero (Lindstrom 2000).
constexpr double kRankCutoff = 1e-3;

/// σn from which single precision serves: the condition of a patch's matrix is at most 1/σn², here 1e4, so that its
/// solution is good to 1e-3 of a step that is itself small wherever the condition is large.
constexpr double kMinBatchSigma = 0.01;

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// KᵀAK.
SymMat3<double> congruent(const SymMat3<double>& A, const Mat3d& K) {
  const Vec3d c0 = K.column(0), c1 = K.column(1), c2 = K.column(2);
  const Vec3d a0 = A * c0, a1 = A * c1, a2 = A * c2;
  return {dot(c0, a0), dot(c0, a1), dot(c0, a2), dot(c1, a1), dot(c1, a2), dot(c2, a2)};
}

}  // namespace

CellMetric::CellMetric(const Mat3d& jacobian, double unit)
    : voxelSize(unit), M(jacobian * (1.0 / unit)), G(congruent(SymMat3<double>::identity(), M)) {
  // A uniform scale's entries are one to rounding; making them so lets such lattices skip the metric altogether.
  constexpr double kRounding = 1e-12;
  const Mat3d I;
  double off = 0;
  for (int i = 0; i < 3; ++i) off = std::max(off, largest(M.row[i] - I.row[i]));
  identity = off < kRounding;
  if (identity) {
    M = I;
    G = SymMat3<double>::identity();
  }
}

SymMat3<double> CellMetric::inverseG() const { return congruent(SymMat3<double>::identity(), inverse(M).transposed()); }

CellMetric blockMetric(const LatticeMap& map, const Vec3d& origin) {
  if (map.affine()) return CellMetric(map.jacobian({}), map.voxelSize());
  constexpr double kMiddle = kBlockSize / 2.0;
  const Mat3d J = map.jacobian(origin + Vec3d{kMiddle, kMiddle, kMiddle});
  return CellMetric(J, std::cbrt(std::abs(J.determinant())));
}

double planeError(const PatchSamples& samples, const Vec3d& x) {
  double sum = 0;
  if (!samples.features.empty()) {
    for (const FeaturePlanes::Plane& p : samples.features) {
      const double distance = dot(vecCast<double>(p.row), x - vecCast<double>(p.point));
      sum += distance * distance;
    }
    return sum / static_cast<double>(samples.features.size());
  }
  for (int i = 0; i < samples.size; ++i) {
    const double distance = dot(samples.row[i], x - samples.position[i]);
    sum += distance * distance;
  }
  return sum / samples.size;
}

VertexSolver::VertexSolver(const SigmaNormal& sigma, double halfSize) : mSigma(sigma), mHalfSize(halfSize) {}

bool VertexSolver::batched() const {
  return mSigma.variance() >= kMinBatchSigma * kMinBatchSigma && std::isfinite(mSigma.variance());
}

SolvedVertex VertexSolver::solve(const PatchSamples& samples, const CellMetric& metric) const {
  if (!samples.features.empty() && !std::isinf(mSigma.variance())) return solveFeatures(samples, metric);
  const double n = samples.size;
  Vec3d positions{};
  Quadric<double> q = Quadric<double>::zero();
  for (int i = 0; i < samples.size; ++i) {
    positions += samples.position[i];
    q += planeQuadric(samples.position[i], samples.row[i]);
  }
  const Vec3d massPoint = positions * (1 / n);
  if (std::isinf(mSigma.variance())) return {massPoint, metric.G * n, Vec3d{}};
  if (samples.noisy) return solveNoisy(samples, massPoint, metric);
  if (mSigma.variance() == 0) return solveClassical(q, massPoint, metric);

  // The sum of probabilisticPlaneQuadric(position, row, Σn), which is the same for all samples.
  const double variance = varianceOf(q.A, n, metric);
  const SymMat3<double> Sigma_n = metric.G * variance;
  q.A += Sigma_n * n;
  q.b += Sigma_n * positions;
  return minimize(q, massPoint, metric);
}

double VertexSolver::varianceOf(const SymMat3<double>& A, double weight, const CellMetric& metric) const {
  if (!mSigma.ofPatches()) return mSigma.variance();
  return metric.identity ? mSigma.variance(A, weight) : mSigma.variance(A, weight, metric.inverseG());
}

SolvedVertex VertexSolver::solveNoisy(const PatchSamples& samples, const Vec3d& massPoint,
                                      const CellMetric& metric) const {
  Quadric<double> q = Quadric<double>::zero();
  Vec3d positions{};
  double weight = 0;
  for (int i = 0; i < samples.size; ++i) {
    Quadric<double> plane = planeQuadric(samples.position[i], samples.row[i]);
    const SymMat3<double> Sigma_n = metric.G * samples.variance[i];
    plane.A += Sigma_n;
    plane.b += Sigma_n * samples.position[i];
    q += plane * samples.weight[i];
    positions += samples.position[i] * samples.weight[i];
    weight += samples.weight[i];
  }
  const SymMat3<double> Sigma_n = metric.G * varianceOf(q.A, weight, metric);
  q.A += Sigma_n * weight;
  q.b += Sigma_n * positions;
  return minimize(q, massPoint, metric);
}

SolvedVertex VertexSolver::solveFeatures(const PatchSamples& samples, const CellMetric& metric) const {
  Vec3d massPoint{};
  for (int i = 0; i < samples.size; ++i) massPoint += samples.position[i] * (1.0 / samples.size);
  Quadric<double> q = Quadric<double>::zero();
  for (const FeaturePlanes::Plane& p : samples.features)
    q += planeQuadric(vecCast<double>(p.point), vecCast<double>(p.row));
  const SymMat3<double> Sigma_n =
      metric.G * (samples.featureSigma * samples.featureSigma * static_cast<double>(samples.features.size()));
  q.A += Sigma_n;
  q.b += Sigma_n * massPoint;
  return minimize(q, massPoint, metric);
}

SolvedVertex VertexSolver::minimize(const Quadric<double>& q, const Vec3d& massPoint, const CellMetric& metric) const {
  // About the mass point the right-hand side is small where the surface is flat, and so is what rounding does to it.
  const auto step = solveLdlt(q.A, q.b - q.A * massPoint);
  if (!step) return solveClassical(q, massPoint, metric);  // σn² drowned in rounding.
  SolvedVertex v{massPoint + *step, q.A, Vec3d{}};
  constrain(v, q.A, q.b);
  v.halfGradient = q.halfGradient(v.x);
  return v;
}

SolvedVertex VertexSolver::solveClassical(Quadric<double> q, const Vec3d& massPoint, const CellMetric& metric) const {
  const Vec3d r = q.b - q.A * massPoint;
  SolvedVertex v{massPoint, q.A, Vec3d{}};
  if (metric.identity) {
    v.x += solvePseudoInverse(q.A, r, kRankCutoff);
  } else {
    // "Shortest" is meant in world space: solve for y = Mx.
    const Mat3d K = inverse(metric.M);
    v.x += K * solvePseudoInverse(congruent(q.A, K), K.transposed() * r, kRankCutoff);
  }
  // Over the cell the minimiser need not be unique; a ridge as strong as the cut-off picks the one near the mass point.
  const SymMat3<double> ridge = metric.G * (kRankCutoff * q.A.trace());
  constrain(v, q.A + ridge, q.b + ridge * massPoint);
  v.halfGradient = q.halfGradient(v.x);
  return v;
}

void VertexSolver::constrain(SolvedVertex& v, const SymMat3<double>& A, const Vec3d& b) const {
  const double reach = largest(v.x);
  v.outOfCell = reach > 0.5;
  v.moved = reach > mHalfSize;
  if (v.moved) v.x = minimizeInCube(A, b, v.x, mHalfSize);
}

}  // namespace pdc::detail
