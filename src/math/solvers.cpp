#include "pdc/math/solvers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pdc {
namespace {

// Three sweeps suffice for almost all matrices; convergence is quadratic.
constexpr int kMaxJacobiSweeps = 12;

/// Zeroes entry (p, q) of the full symmetric matrix m by a rotation, and applies that to the columns of v too.
void rotate(double (&m)[3][3], double (&v)[3][3], int p, int q) {
  if (m[p][q] == 0) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1);
  const double s = t * c;
  const int r = 3 - p - q;
  const double mpq = m[p][q];
  m[p][p] -= t * mpq;
  m[q][q] += t * mpq;
  m[p][q] = m[q][p] = 0;
  const double mpr = m[p][r], mqr = m[q][r];
  m[p][r] = m[r][p] = c * mpr - s * mqr;
  m[q][r] = m[r][q] = s * mpr + c * mqr;
  for (auto& row : v) {
    const double vp = row[p], vq = row[q];
    row[p] = c * vp - s * vq;
    row[q] = s * vp + c * vq;
  }
}

double objective(const SymMat3<double>& A, const Vec3d& b, const Vec3d& x) { return dot(x, A * x) - 2 * dot(b, x); }

/// Keeps the best of the points it is shown.
struct Best {
  const SymMat3<double>& A;
  const Vec3d& b;
  Vec3d x{};
  double value = std::numeric_limits<double>::infinity();

  void offer(const Vec3d& y) {
    const double f = objective(A, b, y);
    if (f < value) {
      value = f;
      x = y;
    }
  }
};

/// The face of the box that v is beyond.
double violatedFace(const Box& box, int axis, double v) { return v < box.lo[axis] ? box.lo[axis] : box.hi[axis]; }

bool within(const Box& box, int axis, double v) { return box.lo[axis] <= v && v <= box.hi[axis]; }

/// Minimises along axis `free`, the other two coordinates of x being fixed.
void minimizeOnEdge(Best& best, Vec3d x, int free, const Box& box) {
  const int i = (free + 1) % 3, j = (free + 2) % 3;
  const double r = best.b[free] - best.A(free, i) * x[i] - best.A(free, j) * x[j];
  x[free] = std::clamp(r / best.A(free, free), box.lo[free], box.hi[free]);
  best.offer(x);
}

/// Minimises over the face where coordinate `fixed` of x is given.
void minimizeOnFace(Best& best, Vec3d x, int fixed, const Box& box) {
  const int j = (fixed + 1) % 3, k = (fixed + 2) % 3;
  const SymMat3<double>& A = best.A;
  const double rj = best.b[j] - A(j, fixed) * x[fixed], rk = best.b[k] - A(k, fixed) * x[fixed];
  const double det = A(j, j) * A(k, k) - A(j, k) * A(j, k);
  x[j] = (A(k, k) * rj - A(j, k) * rk) / det;
  x[k] = (A(j, j) * rk - A(j, k) * rj) / det;
  // As in minimizeInBox(): if the face's own minimiser is outside, some edge that it violates is active.
  const bool outJ = !within(box, j, x[j]), outK = !within(box, k, x[k]);
  if (!outJ && !outK) return best.offer(x);
  if (outJ) {
    Vec3d y = x;
    y[j] = violatedFace(box, j, x[j]);
    minimizeOnEdge(best, y, k, box);
  }
  if (outK) {
    Vec3d y = x;
    y[k] = violatedFace(box, k, x[k]);
    minimizeOnEdge(best, y, j, box);
  }
}

}  // namespace

Eigen3 eigenSymmetric(const SymMat3<double>& A) {
  double m[3][3] = {{A.xx, A.xy, A.xz}, {A.xy, A.yy, A.yz}, {A.xz, A.yz, A.zz}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < kMaxJacobiSweeps; ++sweep) {
    const double off = std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]);
    const double diagonal = std::abs(m[0][0]) + std::abs(m[1][1]) + std::abs(m[2][2]);
    if (!(off > std::numeric_limits<double>::epsilon() * 1e-3 * diagonal)) break;
    rotate(m, v, 0, 1);
    rotate(m, v, 0, 2);
    rotate(m, v, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  const auto swapIfLess = [&](int i, int j) {
    if (m[order[i]][order[i]] < m[order[j]][order[j]]) std::swap(order[i], order[j]);
  };
  swapIfLess(0, 1);
  swapIfLess(1, 2);
  swapIfLess(0, 1);
  Eigen3 e;
  for (int i = 0; i < 3; ++i) {
    const int k = order[i];
    e.value[i] = m[k][k];
    e.vector[i] = {v[0][k], v[1][k], v[2][k]};
  }
  return e;
}

Vec3d solvePseudoInverse(const SymMat3<double>& A, const Vec3d& b, double relativeCutoff, int* rank) {
  const Eigen3 e = eigenSymmetric(A);
  const double cutoff = std::max(relativeCutoff * e.value[0], 0.0);
  Vec3d x{};
  int used = 0;
  for (int i = 0; i < 3 && e.value[i] > cutoff; ++i, ++used) x += e.vector[i] * (dot(e.vector[i], b) / e.value[i]);
  if (rank != nullptr) *rank = used;
  return x;
}

Vec3d minimizeNear(const Quadric<double>& f, const Vec3d& reference, double relativeCutoff, int* rank) {
  return reference + solvePseudoInverse(f.A, f.b - f.A * reference, relativeCutoff, rank);
}

Vec3d minimizeInBox(const SymMat3<double>& A, const Vec3d& b, const Vec3d& free, const Box& box) {
  // On the way from the constrained to the free minimiser the convex f falls all along, so some face that is active at
  // the former is violated by the latter: only the violated faces need a look.
  Best best{A, b};
  bool outside = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (within(box, axis, free[axis])) continue;
    outside = true;
    Vec3d x{};
    x[axis] = violatedFace(box, axis, free[axis]);
    minimizeOnFace(best, x, axis, box);
  }
  return outside ? best.x : free;
}

Vec3d minimizeInCube(const SymMat3<double>& A, const Vec3d& b, const Vec3d& free, double halfSize) {
  const Vec3d h{halfSize, halfSize, halfSize};
  return minimizeInBox(A, b, free, {-h, h});
}

}  // namespace pdc
