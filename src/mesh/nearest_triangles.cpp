#include "mesh/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/faces.h"
#include "mesh/point_triangle.h"

namespace pdc::detail {
namespace {

TrianglePoints points(const TriangleCorners& c) {
  return {vecCast<double>(c[0]), vecCast<double>(c[1]), vecCast<double>(c[2])};
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
  return findBelow(std::numeric_limits<double>::infinity(), p, guess);
}

NearestTriangle NearestTriangles::findBelow(double bound, const Vec3d& p, std::uint32_t guess) const {
  NearestTriangle nearest{.squared = bound};
  const auto visit = [&](std::uint32_t t) {
    const TriangleCorners own = corners(mMesh, triangle(mMesh, t));
    if (!(boxOf(own).squaredDistance(p) < nearest.squared)) return;
    const double squared = squaredToTriangle(p, points(own));
    if (squared < nearest.squared) nearest = {t, squared};
  };
  if (guess != NearestTriangle::kNone) visit(guess);
  mTree.visitNearest(p, nearest.squared, visit);
  return nearest.number != NearestTriangle::kNone ? nearest : NearestTriangle{};
}

NearestTriangle NearestTriangles::find(const Vec3d& p, const Vec3d& normal, std::uint32_t guess) const {
  NearestTriangle nearest;
  double cosine = -3, nearer = 0, reach = nearest.squared;  // Squares, within which distances differ by rounding.
  const auto visit = [&](std::uint32_t t) {
    const double squared = squaredToTriangle(p, points(corners(mMesh, triangle(mMesh, t))));
    if (!(squared < reach)) return;
    const double itsCosine = cosineTo(normal, corners(mMesh, triangle(mMesh, t)));
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
