#pragma once

#include <cstdint>

#include "pdc/math/quadric.h"

/// Batches: kLanes values side by side, each scalar an array over the lanes, so that one instruction takes in many.
/// Long lists are arrays of batches, because the scalars of one batch then share pages and memory is read as one
/// stream.
///
/// A batch is a plain aggregate, uninitialised unless made with {}. get() and set() take lanes from 0 to kLanes - 1 and
/// check nothing. The functions of quadric_batch.h compute with all lanes; what unused ones hold matters to sums only.
namespace pdc {

inline constexpr int kLanes = 16;

/// \returns the number of batches that hold `count` values.
constexpr std::size_t batchCount(std::size_t count) { return (count + kLanes - 1) / kLanes; }

template <typename T>
struct alignas(64) Vec3Lanes {
  T x[kLanes], y[kLanes], z[kLanes];

  [[nodiscard]] constexpr Vec3<T> get(int lane) const { return {x[lane], y[lane], z[lane]}; }
  constexpr void set(int lane, const Vec3<T>& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};

template <typename T>
struct alignas(64) SymMat3Lanes {
  T xx[kLanes], xy[kLanes], xz[kLanes], yy[kLanes], yz[kLanes], zz[kLanes];

  [[nodiscard]] constexpr SymMat3<T> get(int lane) const {
    return {xx[lane], xy[lane], xz[lane], yy[lane], yz[lane], zz[lane]};
  }
  constexpr void set(int lane, const SymMat3<T>& m) {
    xx[lane] = m.xx;
    xy[lane] = m.xy;
    xz[lane] = m.xz;
    yy[lane] = m.yy;
    yz[lane] = m.yz;
    zz[lane] = m.zz;
  }
};

/// Planes through the points q with normals n.
template <typename T>
struct PlaneLanes {
  Vec3Lanes<T> q, n;
};

/// The corners of triangles.
template <typename T>
struct TriangleLanes {
  Vec3Lanes<T> p, q, r;
};

/// The covariance of each corner of triangles.
template <typename T>
struct TriangleCovarianceLanes {
  SymMat3Lanes<T> p, q, r;
};

/// NormalEquations, one per lane.
template <typename T>
struct NormalEquationsLanes {
  using Scalar = T;
  SymMat3Lanes<T> A;
  Vec3Lanes<T> b;

  [[nodiscard]] constexpr NormalEquations<T> get(int lane) const { return {A.get(lane), b.get(lane)}; }
  constexpr void set(int lane, const NormalEquations<T>& e) {
    A.set(lane, e.A);
    b.set(lane, e.b);
  }
  /// Stores A and b and leaves out the constant.
  constexpr void set(int lane, const Quadric<T>& f) { set(lane, f.normalEquations()); }
};

/// Quadrics, one per lane.
template <typename T>
struct QuadricLanes {
  using Scalar = T;
  SymMat3Lanes<T> A;
  Vec3Lanes<T> b;
  T c[kLanes];

  [[nodiscard]] constexpr Quadric<T> get(int lane) const { return {A.get(lane), b.get(lane), c[lane]}; }
  constexpr void set(int lane, const Quadric<T>& f) {
    A.set(lane, f.A);
    b.set(lane, f.b);
    c[lane] = f.c;
  }
};

/// Solutions of 3×3 systems, as solveLdlt() gives them one by one.
template <typename T>
struct SolutionLanes {
  Vec3Lanes<T> x;               ///< Zero where there is none.
  std::uint8_t solved[kLanes];  ///< 1 where the matrix is positive definite to working precision, otherwise 0.
};

}  // namespace pdc
