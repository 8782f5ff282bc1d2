#include "smooth/face_quadrics.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "pdc/math/triangle_quadric.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

/// Noise of a wall's normal per noise of its vertices and length: at √2 a plane quadric pulls along its plane as
/// strongly as the quadric of an even triangle does.
constexpr double kWallNoise = std::numbers::sqrt2;

/// What noise of vertices does to the normal of their triangle, in each component, per edge length.
constexpr double kNormalNoise = 2;

/// What each averaging leaves of the variance of normals, as far as that tells creases from noise. With 0.6 noise of a
/// quarter of an edge is left in place, with 1 creases are averaged away in it.
constexpr double kNoiseLeft = 0.8;

/// Normals may differ by so much, in radians, without noise: surfaces are curved.
constexpr double kFreeTurn = 0.1;

/// The square of twice the area of an even triangle, for an edge of length one.
constexpr double kEvenWeight = 0.75;

template <typename Visit>
void forEachFace(std::size_t n, BlockProgress& progress, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i);
    progress.advance(range.size());
  });
}

}  // namespace

FaceQuadrics::FaceQuadrics(const SmoothedSurface& surface, std::span<const double> sigmas, bool normaliseArea,
                           BlockProgress& progress)
    : mSurface(surface),
      mQuadrics(surface.faces()),
      mNext(surface.faces()),
      mNormals(surface.faces()),
      mNextNormals(surface.faces()),
      mNormalNoise(surface.faces()) {
  const std::size_t triangles = surface.triangles().size();
  forEachFace(surface.faces(), progress, [&](std::size_t i) {
    NormalEquations<double> q = i < triangles ? ofTriangle(i, sigmas) : ofWall(i, sigmas);
    // With the trace for a measure noisy slivers count no more than others, which they would with the area.
    const double trace = q.A.trace();
    if (normaliseArea && trace > 0) q = {q.A * (1 / trace), q.b * (1 / trace)};
    mQuadrics[i] = q;
  });
}

NormalEquations<double> FaceQuadrics::ofTriangle(std::size_t face, std::span<const double> sigmas) {
  const Triangle& t = mSurface.triangles()[face];
  const Vec3d middle = mSurface.middle(face);
  const auto corner = [&](int k) { return mSurface.positions()[t[k]] - middle; };
  const Vec3d p = corner(0), q = corner(1), r = corner(2);
  const double squares = dot(q - p, q - p) + dot(r - q, r - q) + dot(p - r, p - r);
  const double variances = sigmas[t[0]] * sigmas[t[0]] + sigmas[t[1]] * sigmas[t[1]] + sigmas[t[2]] * sigmas[t[2]];
  setNormal(face, cross(q - p, r - p), squares > 0 ? variances / squares : 0);
  return probabilisticTriangleQuadric(p, q, r, sigmas[t[0]], sigmas[t[1]], sigmas[t[2]]).normalEquations();
}

NormalEquations<double> FaceQuadrics::ofWall(std::size_t face, std::span<const double> sigmas) {
  const SmoothedSurface::Wall& wall = mSurface.walls()[face - mSurface.triangles().size()];
  const Buffer<Vec3d>& p = mSurface.positions();
  const Triangle& t = mSurface.triangles()[wall.triangle];
  const Vec3d edge = p[wall.to] - p[wall.from];
  const Vec3d across = cross(edge, cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
  const double l = length(edge), height = length(across);
  if (!(l > 0 && height > 0)) {
    setNormal(face, {0, 0, 0}, 0);
    return NormalEquations<double>::zero();
  }
  const double variance = 0.5 * (sigmas[wall.from] * sigmas[wall.from] + sigmas[wall.to] * sigmas[wall.to]);
  const double noise = kWallNoise * std::sqrt(variance) / l, weight = kEvenWeight * (l * l) * (l * l);
  setNormal(face, across, variance / (l * l));
  return (probabilisticPlaneQuadric(Vec3d{0, 0, 0}, across * (1 / height), noise) * weight).normalEquations();
}

void FaceQuadrics::setNormal(std::size_t face, const Vec3d& normal, double variance) {
  const double l = length(normal);
  mNormals[face] = vecCast<float>(l > 0 ? normal * (1 / l) : Vec3d{0, 0, 0});
  mNormalNoise[face] = static_cast<float>(kNormalNoise * kNormalNoise * variance);
}

NormalEquations<double> FaceQuadrics::about(std::uint32_t face, const Vec3d& point) const {
  const auto& [A, b] = mQuadrics[face];
  return {A, b - A * (point - mSurface.middle(face))};
}

void FaceQuadrics::average(Averaging averaging, BlockProgress& progress) {
  forEachFace(mQuadrics.size(), progress,
              [&](std::size_t i) { averaging == Averaging::kPlain ? averagePlainly(i) : averageByNoise(i); });
  mQuadrics.swap(mNext);
  if (averaging == Averaging::kPlain) return;
  mNormals.swap(mNextNormals);
  mNoiseLeft *= kNoiseLeft;
}

void FaceQuadrics::averagePlainly(std::size_t face) {
  const Vec3d middle = mSurface.middle(face);
  NormalEquations<double> sum = mQuadrics[face];
  for (const std::uint32_t neighbour : mSurface.neighbours(face)) sum += about(neighbour, middle);
  mNext[face] = {sum.A * 0.25, sum.b * 0.25};
}

// Seen from the middle of a face, the plane of a neighbour lies outside of a curved surface by as much as the
// neighbour's middle, seen along the face's normal, lies inside. So each is moved by half its own matrix and half that
// of the face, which also halves what the noise of its normal does to it.
void FaceQuadrics::averageByNoise(std::size_t face) {
  const Vec3d middle = mSurface.middle(face);
  const NormalEquations<double>& own = mQuadrics[face];
  const double trace = own.A.trace();
  NormalEquations<double> sum = own;
  Vec3f normal = mNormals[face];
  double weights = 1;
  for (const std::uint32_t neighbour : mSurface.neighbours(face)) {
    const double w = weight(face, neighbour);
    const auto& [A, b] = mQuadrics[neighbour];
    const Vec3d d = mSurface.middle(neighbour) - middle;
    const double scale = trace > 0 ? A.trace() / trace : 0;
    sum += {A * w, (b + (A * d + own.A * d * scale) * 0.5) * w};
    normal += mNormals[neighbour] * static_cast<float>(w);
    weights += w;
  }
  mNext[face] = {sum.A * (1 / weights), sum.b * (1 / weights)};
  const float l = length(normal);
  mNextNormals[face] = l > 0 ? normal * (1 / l) : mNormals[face];
}

double FaceQuadrics::weight(std::size_t face, std::uint32_t neighbour) const {
  const Vec3f turn = mNormals[neighbour] - mNormals[face];
  const double noise = double{mNormalNoise[face]} + double{mNormalNoise[neighbour]};
  return std::exp(-0.5 * double{dot(turn, turn)} / (noise * mNoiseLeft + kFreeTurn * kFreeTurn));
}

NormalEquations<double> FaceQuadrics::sumAt(std::uint32_t vertex) const {
  const Vec3d& p = mSurface.positions()[vertex];
  NormalEquations<double> sum = NormalEquations<double>::zero();
  for (const Corner& c : mSurface.corners(vertex)) sum += about(c.face, p);
  if (!mSurface.atBoundary(vertex)) return sum;
  // Triangles on one side only would draw the boundary towards them. So the other side has their mirror images.
  const auto walls = mSurface.wallsAt(vertex);
  const Vec3d across = vecCast<double>(mNormals[walls[0]] + mNormals[walls[1]]);
  if (dot(across, across) > 0) {
    const SymMat3<double> R = SymMat3<double>::identity() + outer(across) * (-2 / dot(across, across));
    const Mat3<double> mirror{{Vec3d{R.xx, R.xy, R.xz}, Vec3d{R.xy, R.yy, R.yz}, Vec3d{R.xz, R.yz, R.zz}}};
    sum = {(sum.A + congruence(sum.A, mirror)) * 0.5, (sum.b + R * sum.b) * 0.5};
  }
  for (const std::uint32_t wall : walls) sum += about(wall, p);
  return sum;
}

}  // namespace pdc::detail
