#include "sample/creases/noisy_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

// Chosen with bench/feature_eval on the tuning shapes, noise 0.02 and 0.1.

/// Bends that are expected, per voxel, at most, and where noise hides them. Of flat sheets those fitted with noise of
/// 0.1 voxel are some 0.05.
constexpr double kMostBend = 0.3, kLeastBend = 0.02;
/// What is wrong with heights and normals besides noise, in voxels and without unit.
constexpr double kHeightError = 0.01, kNormalError = 0.01;

/// The unknowns p of w = p0 + p1 u + p2 v + ½ p3 u² + p4 uv + ½ p5 v², the height over the tangent plane at (u, v).
constexpr int kUnknowns = 6;
using Vector = std::array<double, kUnknowns>;
using Matrix = std::array<Vector, kUnknowns>;

/// Solves A x = b, for a positive definite A of which the lower triangle counts, by A = LDLᵀ.
Vector solve(Matrix A, Vector b) {
  Vector inverse;  // The inverse of D. A[j][i] above the diagonal holds D L.
  for (int j = 0; j < kUnknowns; ++j) {
    for (int i = j; i < kUnknowns; ++i)
      for (int k = 0; k < j; ++k) A[i][j] -= A[i][k] * A[k][j];
    inverse[j] = 1 / A[j][j];
    for (int i = j + 1; i < kUnknowns; ++i) {
      A[j][i] = A[i][j];
      A[i][j] *= inverse[j];
    }
  }
  for (int i = 0; i < kUnknowns; ++i)
    for (int k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
  for (int i = kUnknowns - 1; i >= 0; --i) {
    b[i] *= inverse[i];
    for (int k = i + 1; k < kUnknowns; ++k) b[i] -= A[k][i] * b[k];
  }
  return b;
}

/// Each unknown's powers of u and v, and its factor.
constexpr int kU[] = {0, 1, 0, 2, 1, 0}, kV[] = {0, 0, 1, 0, 1, 2};
constexpr double kFactor[] = {1, 1, 1, 0.5, 1, 0.5};

/// Axes of a tangent plane, and its normal.
struct Frame {
  explicit Frame(const Vec3d& normal) : n(normal) {
    const Vec3d other = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    e1 = cross(n, other);
    e1 *= 1 / length(e1);
    e2 = cross(n, e1);
  }
  Vec3d e1, e2, n;
};

/// Sums over samples at (u, v, w) with normals m, by their fit weights.
struct Sums {
  double power[5][5] = {};   ///< Sums of u^i v^j, where i + j ≤ 4.
  double height[3][3] = {};  ///< Sums of w u^i v^j, where i + j ≤ 2.
  double slope[2][3] = {};   ///< Sums of m · e1 and m · e2, times 1, u and v.
  double squares = 0;        ///< Sum of w².
};

Sums sumUp(const SurfaceSamples& samples, const float* fitWeight, const Vec3f& center, const Frame& frame,
           SimdLevel level) {
  constexpr int kPowers = 15, kHeights = 6, kSlopes = 6;
  constexpr int kOf[kPowers][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1},
                                   {1, 2}, {0, 3}, {4, 0}, {3, 1}, {2, 2}, {1, 3}, {0, 4}};
  alignas(64) float power[kPowers][kLanes] = {}, height[kHeights][kLanes] = {}, slope[kSlopes][kLanes] = {},
                    squares[kLanes] = {};
  const Vec3f e1 = vecCast<float>(frame.e1), e2 = vecCast<float>(frame.e2), n = vecCast<float>(frame.n);
  forEachBatch(level, static_cast<std::size_t>(samples.blocks()), [&](std::size_t block) {
    const auto column = [&](int c) { return &samples.column[c][block * kLanes]; };
    const float *nx = column(SurfaceSamples::kNormalX), *ny = column(SurfaceSamples::kNormalY),
                *nz = column(SurfaceSamples::kNormalZ), *fx = column(SurfaceSamples::kFootX),
                *fy = column(SurfaceSamples::kFootY), *fz = column(SurfaceSamples::kFootZ),
                *own = fitWeight + block * kLanes;
    forEachLane([&](int lane) {
      const Vec3f d = Vec3f{fx[lane], fy[lane], fz[lane]} - center, m{nx[lane], ny[lane], nz[lane]};
      const float t = own[lane], u = dot(d, e1), v = dot(d, e2), w = dot(d, n), m1 = t * dot(m, e1),
                  m2 = t * dot(m, e2);
      const float uu = u * u, uv = u * v, vv = v * v;
      const float p[kPowers] = {t,           t * u,       t * v,       t * uu,      t * uv,
                                t * vv,      t * uu * u,  t * uu * v,  t * u * vv,  t * vv * v,
                                t * uu * uu, t * uu * uv, t * uu * vv, t * uv * vv, t * vv * vv};
      for (int k = 0; k < kPowers; ++k) power[k][lane] += p[k];
      for (int k = 0; k < kHeights; ++k) height[k][lane] += p[k] * w;
      squares[lane] += t * w * w;
      const float s[kSlopes] = {m1, m1 * u, m1 * v, m2, m2 * u, m2 * v};
      for (int k = 0; k < kSlopes; ++k) slope[k][lane] += s[k];
    });
  });
  Sums sums;
  for (int k = 0; k < kPowers; ++k) sums.power[kOf[k][0]][kOf[k][1]] = double{sumLanes(power[k])};
  for (int k = 0; k < kHeights; ++k) sums.height[kOf[k][0]][kOf[k][1]] = double{sumLanes(height[k])};
  for (int k = 0; k < kSlopes; ++k) sums.slope[k / 3][k % 3] = double{sumLanes(slope[k])};
  sums.squares = double{sumLanes(squares)};
  return sums;
}

/// The paraboloid that fits heights and slopes best.
/// \param usualBend that is expected.
Vector fit(const Sums& s, double normalNoise, double usualBend) {
  const double heightNoise = normalNoise / kNormalNoise;
  const double ofHeight = 1 / (heightNoise * heightNoise + kHeightError * kHeightError),
               ofNormal = 1 / (normalNoise * normalNoise + kNormalError * kNormalError);
  Matrix A{};
  Vector b{};
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j <= i; ++j) A[i][j] = ofHeight * kFactor[i] * kFactor[j] * s.power[kU[i] + kU[j]][kV[i] + kV[j]];
    b[i] = ofHeight * kFactor[i] * s.height[kU[i]][kV[i]];
  }
  // Slopes: −(p1 + p3 u + p4 v) and −(p2 + p4 u + p5 v).
  constexpr int kUnknown[2][3] = {{1, 3, 4}, {2, 4, 5}};
  for (int axis = 0; axis < 2; ++axis)
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j)
        A[kUnknown[axis][i]][kUnknown[axis][j]] += ofNormal * s.power[kU[i] + kU[j]][kV[i] + kV[j]];
      b[kUnknown[axis][i]] -= ofNormal * s.slope[axis][i];
    }
  constexpr double kTiny = 1e-3;  // Samples in one place leave slopes open.
  for (int i = 0; i < kUnknowns; ++i) A[i][i] += i < 3 ? kTiny : 1 / (usualBend * usualBend);
  return solve(A, b);
}

/// What a paraboloid leaves of the squares of the heights.
double heightError(const Sums& s, const Vector& p) {
  double error = s.squares;
  for (int i = 0; i < kUnknowns; ++i) {
    error -= 2 * p[i] * kFactor[i] * s.height[kU[i]][kV[i]];
    for (int j = 0; j < kUnknowns; ++j)
      error += p[i] * p[j] * kFactor[i] * kFactor[j] * s.power[kU[i] + kU[j]][kV[i] + kV[j]];
  }
  return std::max(error, 0.0);
}

}  // namespace

NoisyFit fitNoisySheet(const SurfaceSamples& samples, const float* fitWeight, const CreaseSheet& sheet,
                       double normalNoise, SimdLevel level) {
  const Frame f(sheet.normal);
  const Sums sums = sumUp(samples, fitWeight, vecCast<float>(sheet.center), f, level);
  // Bends that are no larger than what noise makes of flat sheets are taken for that.
  const Vector free = fit(sums, normalNoise, kMostBend);
  const double bend = std::sqrt(free[3] * free[3] + 2 * free[4] * free[4] + free[5] * free[5]);
  const Vector p = fit(sums, normalNoise, std::max(kLeastBend, bend * bend / (bend + normalNoise)));
  CreaseSheet fitted = sheet;
  const Vec3d gradient = f.n - f.e1 * p[1] - f.e2 * p[2];
  const double l = length(gradient);
  fitted.normal = gradient * (1 / l);
  fitted.offset = p[0] / l;
  for (int k = 0; k < 3; ++k)
    fitted.bend.row[k] =
        (f.e1 * (p[3] * f.e1[k] + p[4] * f.e2[k]) + f.e2 * (p[4] * f.e1[k] + p[5] * f.e2[k])) * (-1 / l);
  return {fitted, heightError(sums, p)};
}

}  // namespace pdc::detail
