#include "eigen_solvers.h"

#include <Eigen/Dense>

namespace pdc::bench {
namespace {

template <typename T>
using Matrix = Eigen::Matrix<T, 3, 3>;
template <typename T>
using Vector = Eigen::Matrix<T, 3, 1>;

constexpr unsigned kVectors = Eigen::ComputeFullU | Eigen::ComputeFullV;

template <typename T>
Matrix<T> matrix(const SymMat3<T>& A) {
  Matrix<T> m;
  m << A.xx, A.xy, A.xz, A.xy, A.yy, A.yz, A.xz, A.yz, A.zz;
  return m;
}

template <typename T>
Vector<T> vector(const Vec3<T>& b) {
  return {b.x, b.y, b.z};
}

}  // namespace

template <typename T>
Vec3<T> solveJacobiSvd(const Quadric<T>& f) {
  const Vector<T> x = Eigen::JacobiSVD<Matrix<T>>(matrix(f.A), kVectors).solve(vector(f.b));
  return {x[0], x[1], x[2]};
}

template <typename T>
Vec3<T> solveBdcSvd(const Quadric<T>& f) {
  const Vector<T> x = Eigen::BDCSVD<Matrix<T>>(matrix(f.A), kVectors).solve(vector(f.b));
  return {x[0], x[1], x[2]};
}

template <typename T>
Vec3<T> solveEigenDirect(const Quadric<T>& f) {
  Eigen::SelfAdjointEigenSolver<Matrix<T>> solver;
  solver.computeDirect(matrix(f.A));
  const Vector<T> y = solver.eigenvectors().transpose() * vector(f.b);
  const Vector<T> x = solver.eigenvectors() * y.cwiseQuotient(solver.eigenvalues());
  return {x[0], x[1], x[2]};
}

template Vec3<float> solveJacobiSvd(const Quadric<float>&);
template Vec3<double> solveJacobiSvd(const Quadric<double>&);
template Vec3<float> solveBdcSvd(const Quadric<float>&);
template Vec3<double> solveBdcSvd(const Quadric<double>&);
template Vec3<float> solveEigenDirect(const Quadric<float>&);
template Vec3<double> solveEigenDirect(const Quadric<double>&);

}  // namespace pdc::bench
