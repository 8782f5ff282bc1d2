#pragma once

#include <cstddef>
#include <vector>

#include "pdc/math/quadric.h"
#include "quadric_inputs.h"

/// The authors' implementation, https://github.com/Philip-Trettner/probabilistic-quadrics, where it is on the include
/// path.
#if __has_include("minimal-math.hh")
#include "minimal-math.hh"
#define PDC_BENCH_HAS_AUTHORS_HEADER 1

namespace pdc::bench {

/// The inputs in the types of that header.
template <typename T>
struct AuthorsInputs {
  using Quadric = pq::quadric<pq::minimal_math<T>>;
  using Pos = typename Quadric::pos3;
  using Vec = typename Quadric::vec3;
  using Mat = typename Quadric::mat3;

  std::vector<Pos> p, q, r;
  std::vector<Vec> n;
  std::vector<Mat> Sp, Sq, Sr;
  std::vector<Quadric> quadrics;

  explicit AuthorsInputs(const QuadricInputs<T>& in) {
    for (std::size_t i = 0; i < in.p.size(); ++i) {
      p.push_back({in.p[i].x, in.p[i].y, in.p[i].z});
      q.push_back({in.q[i].x, in.q[i].y, in.q[i].z});
      r.push_back({in.r[i].x, in.r[i].y, in.r[i].z});
      n.push_back({in.n[i].x, in.n[i].y, in.n[i].z});
      Sp.push_back(matrix(in.Sp[i]));
      Sq.push_back(matrix(in.Sq[i]));
      Sr.push_back(matrix(in.Sr[i]));
      const auto& f = in.quadrics[i];
      quadrics.push_back(
          Quadric::from_coefficients(f.A.xx, f.A.xy, f.A.xz, f.A.yy, f.A.yz, f.A.zz, f.b.x, f.b.y, f.b.z, f.c));
    }
  }

  static Mat matrix(const SymMat3<T>& m) {
    Mat r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r[i][j] = m(i, j);
    return r;
  }
};

/// Stores all of a quadric, or A and b.
template <typename Out, typename T>
struct AuthorsOutput {
  using Type = typename AuthorsInputs<T>::Quadric;
  static const Type& of(const Type& f) { return f; }
};
template <typename T>
struct AuthorsOutput<NormalEquations<T>, T> {
  using Type = NormalEquations<T>;
  static Type of(const typename AuthorsInputs<T>::Quadric& f) {
    return {{f.A00, f.A01, f.A02, f.A11, f.A12, f.A22}, {f.b0, f.b1, f.b2}};
  }
};

}  // namespace pdc::bench
#else
#define PDC_BENCH_HAS_AUTHORS_HEADER 0
#endif
