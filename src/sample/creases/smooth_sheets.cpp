#include "sample/creases/smooth_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pdc/math/solvers.h"
#include "sample/creases/sheet_cosine.h"

namespace pdc::detail {
namespace {

// The constants were chosen with bench/kinds_eval: the tuning kinds as level sets, noise 0, 0.05 and 0.1 voxels.

/// The sides of a crease are planes or gently curved: the variance of their normals is at most this, a sheet of radius
/// 3 voxels has 0.05, and that which noise adds.
constexpr double kMostSpread = 0.05, kMostSpreadPerNoise = 0.25;
/// One curved sheet must leave more variance of the normals than two sheets by this factor, which is larger where noise
/// can part a plane in two. On the creases of solids the factor is 2 to 8 with noise of 0.1 voxel and thousands without
/// noise; on spheres, strands and blobs it is 0.05 without noise and at most 1.8 with it.
constexpr double kFactor = 1, kFactorPerNoise = 2.5, kMostFactorOfNoise = 0.5;
/// One curved sheet must leave at least this share of the variance: less is rounding.
constexpr double kLeastShare = 0.001;
/// With noise the heights, which findSheets() does not look at, must agree: by what factor one sheet must leave more of
/// them than two, and what that of the normals times its root must be.
constexpr double kHeightFactor = 1.3, kBothFactors = 2;
/// Keeps the fit of few samples regular, in voxels squared.
constexpr double kRidge = 1e-3;
/// No division by zero.
constexpr double kTiny = 1e-12;

/// Moments of a sheet with a total fit weight of one half.
SheetMoments halfWeight(const SheetMoments& moments) {
  SheetMoments m = moments;
  const double factor = 0.5 / m.sum[SheetMoments::kFitWeight];
  for (double& v : m.sum) v *= factor;
  return m;
}

/// The variance of normals about their mean.
double spread(const SheetMoments& m) {
  const Vec3d mean = m.vector(SheetMoments::kNormal) * (1 / m.sum[SheetMoments::kFitWeight]);
  return 1 - dot(mean, mean);
}

/// The variance of normals about a linear function of their foot points, which they are on spheres and cylinders.
/// \param m with a total weight of one.
double bentSpread(const SheetMoments& m) {
  const Vec3d foot = m.vector(SheetMoments::kFoot), mean = m.vector(SheetMoments::kNormal);
  const double* ff = &m.sum[SheetMoments::kFootFoot];
  const SymMat3<double> F = SymMat3<double>{ff[0], ff[1], ff[2], ff[3], ff[4], ff[5]} - outer(foot);
  const SymMat3<double> damped = F.plusDiagonal(kRidge);
  double left = spread(m);
  for (int k = 0; k < 3; ++k) {
    const Vec3d covariance = m.vector(SheetMoments::kNormalFoot + 3 * k) - foot * mean[k];
    if (const auto row = solveLdlt(damped, covariance)) left -= dot(*row, covariance);
  }
  return left;
}

/// Whether two sheets explain their samples better than one.
bool meetInCrease(const CreaseSheet& a, const CreaseSheet& b, const CreaseSheet& joined, double normalNoise) {
  const double apart = 0.5 * (spread(a.moments) + spread(b.moments));
  if (apart > kMostSpread + kMostSpreadPerNoise * normalNoise) return false;
  // Each sheet counts the same, however many samples it has: few say as well that it is there.
  SheetMoments both = halfWeight(a.moments);
  both += halfWeight(b.moments);
  const double bent = bentSpread(both), factor = kFactor + std::min(kMostFactorOfNoise, kFactorPerNoise * normalNoise);
  if (!(bent > factor * apart && bent > kLeastShare * spread(both))) return false;
  if (!isNoisy(normalNoise)) return true;
  const double ofNormals = bent / (apart + kTiny),
               ofHeights = joined.heightError / (a.heightError + b.heightError + kTiny);
  return ofHeights > kHeightFactor && ofNormals * std::sqrt(ofHeights) > kBothFactors;
}

}  // namespace

void joinSmoothSheets(const SurfaceSamples& samples, double normalNoise, CreaseSheets& sheets, SheetWeights& weights,
                      SimdLevel level) {
  std::array<std::array<bool, CreaseSheets::kMax>, CreaseSheets::kMax> apart{};
  while (true) {
    int first = -1, second = -1;
    double most = kBackToBack;
    for (int i = 0; i < sheets.count; ++i)
      for (int k = 0; k < i; ++k) {
        const double cosine = dot(sheets.sheet[i].normal, sheets.sheet[k].normal);
        if (apart[i][k] || !(cosine > most)) continue;
        most = cosine;
        first = k;
        second = i;
      }
    if (first < 0) return;
    CreaseSheet &a = sheets.sheet[first], &b = sheets.sheet[second];
    const CreaseSheet joined = joinSheets(samples, a, b, normalNoise, weights, level);
    if (meetInCrease(a, b, joined, normalNoise)) {
      apart[second][first] = true;
    } else {
      if (isNoisy(normalNoise)) weights.of[joined.number] = weights.joined;
      a = joined;
      sheets.drop(second);
      apart = {};
    }
  }
}

}  // namespace pdc::detail
