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

/// Planes from distances that replace a patch's own, with a noise of their own.
PatchQuadric featureQuadric(const PatchSamples& samples, const CellMetric& metric) {
  Vec3d massPoint{};
  for (int i = 0; i < samples.size; ++i) massPoint += samples.position[i] * (1.0 / samples.size);
  Quadric<double> q = Quadric<double>::zero();
  for (const FeaturePlanes::Plane& p : samples.features)
    q += planeQuadric(vecCast<double>(p.point), vecCast<double>(p.row));
  const SymMat3<double> Sigma_n =
      metric.G * (samples.featureSigma * samples.featureSigma * static_cast<double>(samples.features.size()));
  // As if all planes passed through the mass point: their own points may lie outside the cell.
  q += normalNoiseQuadric(Sigma_n, 1.0, massPoint, quadraticForm(Sigma_n, massPoint));
  return {q, massPoint};
}

}  // namespace

VertexSolver::VertexSolver(const SigmaNormal& sigma, double halfSize) : mSigma(sigma), mHalfSize(halfSize) {}

bool VertexSolver::batched() const {
  return mSigma.variance() >= kMinBatchSigma * kMinBatchSigma && std::isfinite(mSigma.variance());
}

SolvedVertex VertexSolver::solve(const PatchSamples& samples, const CellMetric& metric) const {
  const PatchQuadric patch = quadric(samples, metric);
  if (std::isinf(mSigma.variance())) return {patch.massPoint, patch.q.A, Vec3d{}};
  const bool noise = mSigma.variance() != 0 || samples.noisy || !samples.features.empty();
  return noise ? minimize(patch, metric) : solveClassical(patch, metric);
}

PatchQuadric VertexSolver::quadric(const PatchSamples& samples, const CellMetric& metric) const {
  if (std::isinf(mSigma.variance())) return plainQuadric(samples, metric);
  if (!samples.features.empty()) return featureQuadric(samples, metric);
  return samples.noisy ? noisyQuadric(samples, metric) : plainQuadric(samples, metric);
}

PatchQuadric VertexSolver::plainQuadric(const PatchSamples& samples, const CellMetric& metric) const {
  const double n = samples.size;
  Vec3d positions{};
  double squares = 0;
  Quadric<double> q = Quadric<double>::zero();
  for (int i = 0; i < samples.size; ++i) {
    positions += samples.position[i];
    squares += quadraticForm(metric.G, samples.position[i]);
    q += planeQuadric(samples.position[i], samples.row[i]);
  }
  const Vec3d massPoint = positions * (1 / n);
  if (std::isinf(mSigma.variance())) return {normalNoiseQuadric(metric.G, n, positions, squares), massPoint};
  const double variance = varianceOf(q.A, n, samples, metric);
  if (variance != 0) q += normalNoiseQuadric(metric.G * variance, n, positions, variance * squares);
  return {q, massPoint};
}

PatchQuadric VertexSolver::noisyQuadric(const PatchSamples& samples, const CellMetric& metric) const {
  Quadric<double> q = Quadric<double>::zero();
  Vec3d positions{}, weighted{};
  double weight = 0, squares = 0;
  for (int i = 0; i < samples.size; ++i) {
    const Vec3d& p = samples.position[i];
    q += probabilisticPlaneQuadric(p, samples.row[i], metric.G * samples.variance[i]) * samples.weight[i];
    positions += p;
    weighted += p * samples.weight[i];
    weight += samples.weight[i];
    squares += samples.weight[i] * quadraticForm(metric.G, p);
  }
  const double variance = varianceOf(q.A, weight, samples, metric);
  q += normalNoiseQuadric(metric.G * variance, weight, weighted, variance * squares);
  return {q, positions * (1 / double(samples.size))};
}

double VertexSolver::varianceOf(const SymMat3<double>& A, double weight, const PatchSamples& samples,
                                const CellMetric& metric) const {
  if (!mSigma.ofPatches()) return mSigma.variance();
  const PatchSpread<double> spread =
      metric.identity ? mSigma.spread(A, weight) : mSigma.spread(A, weight, metric.inverseG());
  const double residual = spread.excess > SigmaNormal::kLeastSpread ? chordResidual(samples, metric) : 0;
  return mSigma.variance(spread, residual);
}

SolvedVertex VertexSolver::minimize(const PatchQuadric& patch, const CellMetric& metric) const {
  const auto& [q, massPoint] = patch;
  // About the mass point the right-hand side is small where the surface is flat, and so is what rounding does to it.
  const auto step = solveLdlt(q.A, q.b - q.A * massPoint);
  if (!step) return solveClassical(patch, metric);  // σn² drowned in rounding.
  SolvedVertex v{massPoint + *step, q.A, Vec3d{}};
  constrain(v, q.normalEquations());
  v.halfGradient = q.halfGradient(v.x);
  return v;
}

SolvedVertex VertexSolver::solveClassical(const PatchQuadric& patch, const CellMetric& metric) const {
  const auto& [q, massPoint] = patch;
  const Vec3d r = q.b - q.A * massPoint;
  SolvedVertex v{massPoint, q.A, Vec3d{}};
  if (metric.identity) {
    v.x += solvePseudoInverse(q.A, r, kRankCutoff);
  } else {
    // "Shortest" is meant in world space: solve for y = Mx.
    const Mat3d K = inverse(metric.M);
    v.x += K * solvePseudoInverse(congruence(q.A, K), K.transposed() * r, kRankCutoff);
  }
  // Over the cell the minimiser need not be unique; a ridge as strong as the cut-off picks the one near the mass point.
  const SymMat3<double> ridge = metric.G * (kRankCutoff * q.A.trace());
  constrain(v, {q.A + ridge, q.b + ridge * massPoint});
  v.halfGradient = q.halfGradient(v.x);
  return v;
}

void VertexSolver::constrain(SolvedVertex& v, const NormalEquations<double>& system) const {
  const double reach = std::max({std::abs(v.x.x), std::abs(v.x.y), std::abs(v.x.z)});
  v.outOfCell = reach > 0.5;
  v.moved = reach > mHalfSize;
  if (v.moved) v.x = minimizeInCube(system.A, system.b, v.x, mHalfSize);
}

}  // namespace pdc::detail
