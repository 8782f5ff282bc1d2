#pragma once

#include "pdc/math/solvers.h"
#include "simplify/vertex_quadrics.h"

// What the quadrics of an edge's two ends sum up to about its middle. Free of branches, for the sake of batches.
namespace pdc::detail {

/// How strongly vertices are drawn to the plane on which they keep the volume, relative to the faces' own planes. With
/// 0 means of distances are 1 to 4 % more, with 10 the farthest thousandth is up to 4 % farther.
inline constexpr double kVolumeWeight = 1;

/// No vertex goes farther from the middle of its edge than this, in lengths of the edge: the planes of nearly flat
/// faces meet anywhere.
inline constexpr double kMostMove = 2;

/// The sum of two quadrics, one about a vertex at -half, one about a vertex at half, about the origin.
inline Quadric<double> sumAboutMiddle(const Quadric<double>& a, const Quadric<double>& b, const Vec3d& half) {
  const Vec3d h = half, Aa = a.A * h, Ab = b.A * h;
  return {{a.A.xx + b.A.xx, a.A.xy + b.A.xy, a.A.xz + b.A.xz, a.A.yy + b.A.yy, a.A.yz + b.A.yz, a.A.zz + b.A.zz},
          {a.b.x + b.b.x + Ab.x - Aa.x, a.b.y + b.b.y + Ab.y - Aa.y, a.b.z + b.b.z + Ab.z - Aa.z},
          dot(h, Aa) + dot(h, Ab) + 2 * (dot(b.b, h) - dot(a.b, h)) + a.c + b.c};
}

/// The squared distance to the plane on which the volume is kept (Lindstrom & Turk 1998), about the middle of the edge.
/// \param between sum of the vectors of the faces at the edge.
inline Quadric<double> volumePlane(const VertexQuadric& a, const VertexQuadric& b, const Vec3d& half,
                                   const Vec3d& between) {
  constexpr double kTiny = 1e-300;
  const Vec3d n = a.vectorArea + b.vectorArea - between;
  const double weight = kVolumeWeight * (a.weight + b.weight) / (dot(n, n) + kTiny);
  // Each end's faces hold the end, so all of their planes are at n · end.
  const double offset = dot(b.vectorArea - a.vectorArea, half);
  const Vec3d w = n * weight;
  return {{n.x * w.x, n.x * w.y, n.x * w.z, n.y * w.y, n.y * w.z, n.z * w.z},
          {w.x * offset, w.y * offset, w.z * offset},
          offset * offset * weight};
}

/// The least error of an edge's vertex, if it has a place near the edge.
struct EdgeMinimum {
  Vec3d place;  ///< From the middle.
  double cost;  ///< May be below 0 by rounding.
  bool found;
};

/// Written member by member, because g++ does not vectorise loops in which quadrics are copied.
inline EdgeMinimum minimizeOnEdge(const VertexQuadric& a, const VertexQuadric& b, const Vec3d& half,
                                  const Vec3d& between) {
  const Quadric<double> error = sumAboutMiddle(a.q, b.q, half), volume = volumePlane(a, b, half, between);
  const SymMat3<double> A{error.A.xx + volume.A.xx, error.A.xy + volume.A.xy, error.A.xz + volume.A.xz,
                          error.A.yy + volume.A.yy, error.A.yz + volume.A.yz, error.A.zz + volume.A.zz};
  const Vec3d r{error.b.x + volume.b.x, error.b.y + volume.b.y, error.b.z + volume.b.z};
  Vec3d x{};
  const bool solved = ldlt(A, r, x);
  const bool isNear = dot(x, x) <= 4 * kMostMove * kMostMove * dot(half, half);
  return {x, error(x), (solved & isNear) != 0};
}

}  // namespace pdc::detail
