#include "mesh/nearest_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/faces.h"

namespace pdc::detail {
namespace {

double squaredToSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double l = dot(ab, ab);
  const double t = l > 0 ? std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : 0;
  const Vec3d d = p - a - ab * t;
  return dot(d, d);
}

double squaredToTriangle(const Vec3d& p, const TriangleCorners& corners) {
  const std::array<Vec3d, 3> v{vecCast<double>(corners[0]), vecCast<double>(corners[1]), vecCast<double>(corners[2])};
  const Vec3d n = cross(v[1] - v[0], v[2] - v[0]);
  const double area = dot(n, n);
  bool above = area > 0;
  for (int k = 0; k < 3 && above; ++k) above = dot(cross(n, v[(k + 1) % 3] - v[k]), p - v[k]) >= 0;
  if (above) {
    const double h = dot(n, p - v[0]);
    return h * h / area;
  }
  return std::min({squaredToSegment(p, v[0], v[1]), squaredToSegment(p, v[1], v[2]), squaredToSegment(p, v[2], v[0])});
}

Buffer<std::uint32_t> finiteTriangles(const Mesh& mesh) {
  Buffer<std::uint32_t> numbers;
  numbers.reserve(triangleCount(mesh));
  for (std::size_t i = 0; i < triangleCount(mesh); ++i) {
    const auto c = corners(mesh, triangle(mesh, i));
    if (std::all_of(c.begin(), c.end(), isFinite)) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

/// Some orders of magnitude more than what double precision leaves of coordinates of that size.
double roundingOf(const Mesh& mesh) {
  float largest = 0;
  for (const Vec3f& p : mesh.positions)
    if (isFinite(p)) largest = std::max(largest, largestEntry(p));
  return 1e-12 * largest;
}

/// The cosine of the angle between a unit vector and a triangle's normal; less than all where it has none.
double cosineTo(const Vec3d& normal, const TriangleCorners& corners) {
  const Vec3d n = areaNormal(corners);
  const double l = length(n);
  return l > 0 ? dot(n, normal) / l : -2;
}

}  // namespace

Vec3d areaNormal(const TriangleCorners& corners) {
  const Vec3d a = vecCast<double>(corners[0]);
  return cross(vecCast<double>(corners[1]) - a, vecCast<double>(corners[2]) - a);
}

NearestTriangles::NearestTriangles(const Mesh& mesh)
    : mMesh(mesh), mTree(mesh, finiteTriangles(mesh)), mRounding(roundingOf(mesh)) {}

NearestTriangle NearestTriangles::find(const Vec3d& p, std::uint32_t guess) const {
  NearestTriangle nearest;
  const auto visit = [&](std::uint32_t t) {
    const double squared = squaredToTriangle(p, corners(mMesh, triangle(mMesh, t)));
    if (squared < nearest.squared) nearest = {t, squared};
  };
  if (guess != NearestTriangle::kNone) visit(guess);
  mTree.visitNearest(p, nearest.squared, visit);
  return nearest;
}

NearestTriangle NearestTriangles::find(const Vec3d& p, const Vec3d& normal, std::uint32_t guess) const {
  NearestTriangle nearest;
  double cosine = -3, nearer = 0, reach = nearest.squared;  // Squares, within which distances differ by rounding.
  const auto visit = [&](std::uint32_t t) {
    const TriangleCorners c = corners(mMesh, triangle(mMesh, t));
    const double squared = squaredToTriangle(p, c);
    if (!(squared < reach)) return;
    const double itsCosine = cosineTo(normal, c);
    if (squared < nearer || itsCosine > cosine || nearest.number == NearestTriangle::kNone) {
      nearest.number = t;
      cosine = itsCosine;
    }
    if (squared >= nearest.squared) return;
    const double d = std::sqrt(squared);
    nearest.squared = squared;
    nearer = d > mRounding ? (d - mRounding) * (d - mRounding) : 0;
    reach = (d + mRounding) * (d + mRounding);
  };
  if (guess != NearestTriangle::kNone) visit(guess);
  mTree.visitNearest(p, reach, visit);
  return nearest;
}

}  // namespace pdc::detail
