#include "pdc/math/solve_quality.h"

#include <limits>

#include "pdc/math/solvers.h"

namespace pdc {

SolveQuality solveQuality(const SymMat3<double>& A, double relativeCutoff) {
  const Eigen3 e = eigenSymmetric(A);
  SolveQuality quality{std::numeric_limits<double>::infinity(), 0};
  for (const double value : e.value) quality.rank += value > 0 && value > relativeCutoff * e.value[0];
  if (e.value[2] > 0) quality.condition = e.value[0] / e.value[2];
  return quality;
}

std::optional<SymMat3<double>> solutionCovariance(const SymMat3<double>& A, double residualVariance) {
  Vec3d x, y, z;
  if (!detail::ldlt(A, Vec3d{1, 0, 0}, x)) return std::nullopt;
  detail::ldlt(A, Vec3d{0, 1, 0}, y);
  detail::ldlt(A, Vec3d{0, 0, 1}, z);
  return SymMat3<double>{x.x, y.x, z.x, y.y, z.y, z.z} * residualVariance;
}

}  // namespace pdc
