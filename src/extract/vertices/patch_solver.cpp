#include "extract/vertices/patch_solver.h"

#include <algorithm>
#include <cmath>

#include "extract/vertices/cell_rounding.h"
#include "sample/creases/sheet_cosine.h"

namespace pdc::detail {
namespace {

/// A vertex does not leave its cell if its planes stay nearer than this, in voxels, or nearer than `kFit` times what
/// they are from its free place: where noise keeps them from meeting, vertices outside their cells fold faces and are
/// no more exact. Beside creases the free place is many times nearer. With kFit 1 instead of 2, noise of 0.1 voxel and
/// plain gradients, eight times as many vertices are drawn back, and the dragon takes twice as long.
constexpr double kFlatness = 1e-3, kFit = 2;

/// Exact normals tell of a crease if a vertex misses their planes by no more, in voxels.
constexpr double kExact = 0.01;

template <typename T>
void clampToCube(Vec3<T>& x, double halfSize) {
  for (int i = 0; i < 3; ++i) x[i] = std::clamp(x[i], static_cast<T>(-halfSize), static_cast<T>(halfSize));
}

float reach(const Vec3f& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

constexpr Vec3d kHalf{0.5, 0.5, 0.5};

}  // namespace

PatchSolver::PatchSolver(const BlockSampler& sampler, const CrossingPlanes& crossings, const VertexSolver& solver)
    : mSampler(sampler),
      mCrossings(crossings),
      mSolver(solver),
      mExactNormals(sampler.source().knowledge().exactNormals) {
  mSamples.noisy = sampler.noise() != nullptr;
}

void PatchSolver::load(std::size_t patch, const EdgeIndex& edges) {
  const SurfacePatch& own = mSampler.patches()[patch];
  const PlaneNoise* noise = mSampler.noise();
  mSamples.size = 0;
  forEachEdge(own, edges, [&](int e, int edge) {
    const int k = mSamples.size++;
    mAxis[k] = kCellEdge[e].axis;
    mSamples.position[k] = cornerPlace(kCellEdge[e].low) - kHalf;
    mSamples.position[k][mAxis[k]] += double(mCrossings.t(edge));
    mSamples.row[k] = vecCast<double>(mCrossings.plane(edge));
    if (noise == nullptr) return;
    const double sigma = noise->sigma[edge];
    mSamples.variance[k] = sigma * sigma;
    mSamples.weight[k] = std::max(noise->weight[edge], CrossingPlanes::kLeastWeight);
  });
  mSamples.features = {};
  if (const FeaturePlanes::Patch* feature = mSampler.features().find(patch)) {
    const std::span<const FeaturePlanes::Plane> planes = mSampler.features().of(*feature);
    mFeatures.assign(planes.begin(), planes.end());
    const Vec3f center = vecCast<float>(cellCenter(own.cell));
    for (FeaturePlanes::Plane& p : mFeatures) p.point -= center;
    mSamples.features = mFeatures;
    mSamples.featureSigma = feature->sigmaNormal;
  }
}

CellPlacement PatchSolver::placeInCell(const Vec3d& x, bool ambiguous, double cellHalfSize,
                                       const CellMetric& metric) const {
  Vec3f free = vecCast<float>(x);
  Vec3d safe{};
  if (ambiguous) {
    safe = innerMassPoint();
  } else if (reach(free) <= cellHalfSize + kSnap) {
    clampToCube(free, cellHalfSize);
    return {free};
  } else {
    safe = VertexSolver(mSolver.sigma(), cellHalfSize).solve(mSamples, metric).x;
    const double fit = mExactNormals ? 1 : kFit;  // Without noise nearer is better.
    if (planeError(mSamples, safe) <= fit * fit * planeError(mSamples, x) + kFlatness * kFlatness)
      return {vecCast<float>(safe)};
  }
  clampToCube(safe, cellHalfSize);
  return {free, vecCast<float>(safe)};
}

std::array<Vec3f, 4> PatchSolver::creaseNormals(const Vec3d& x, const CellMetric& metric) const {
  std::array<Vec3f, 4> normals{};
  std::size_t count = 0;
  const Mat3d toWorld = inverse(metric.M).transposed();
  const auto add = [&](const Vec3d& row) {
    const Vec3d n = toWorld * row;
    const double l = length(n);
    if (!(l > 0)) return;
    const Vec3f normal = vecCast<float>(n * (1 / l));
    const auto alike = [&](const Vec3f& other) { return dot(other, normal) > kSheetCosine; };
    if (count < normals.size() && std::none_of(normals.begin(), normals.begin() + count, alike))
      normals[count++] = normal;
  };
  if (!mSamples.features.empty()) {
    for (const FeaturePlanes::Plane& p : mSamples.features) add(vecCast<double>(p.row));
  } else if (mExactNormals && planeError(mSamples, x) <= kExact * kExact) {
    for (int i = 0; i < mSamples.size; ++i) add(mSamples.row[i]);
  }
  return normals;
}

/// The mass point, away from where two patches may touch: crossings at the very ends of their edges.
Vec3d PatchSolver::innerMassPoint() const {
  constexpr double kInner = 0.49;
  Vec3d mean{};
  for (int i = 0; i < mSamples.size; ++i) {
    Vec3d p = mSamples.position[i];
    p[mAxis[i]] = std::clamp(p[mAxis[i]], -kInner, kInner);
    mean += p * (1.0 / mSamples.size);
  }
  return mean;
}

}  // namespace pdc::detail
