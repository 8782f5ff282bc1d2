// Prints two tables in Markdown: the relative error of 3×3 solvers on random systems of growing condition, and the
// error of triangle quadrics in single precision far from the origin, in local frames and in the scene's.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "math/global_frame_quadric.h"
#include "math/random_geometry.h"
#include "pdc/math/solvers.h"
#include "pdc/math/triangle_quadric.h"

namespace {

using namespace pdc;

constexpr int kDecades = 12;
constexpr int kSystems = 1'000'000;

/// The relative errors of one solver at one condition, and how often it declined.
struct Errors {
  std::vector<double> relative;
  int declined = 0;

  [[nodiscard]] std::array<double, 2> medianAndLargest() {
    if (relative.empty()) return {NAN, NAN};
    const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::nth_element(relative.begin(), middle, relative.end());
    return {*middle, *std::max_element(relative.begin(), relative.end())};
  }
};

template <typename T>
Vec3<T> solveCramer(const SymMat3<T>& A, const Vec3<T>& b) {
  const Mat3<T> M{{Vec3<T>{A.xx, A.xy, A.xz}, Vec3<T>{A.xy, A.yy, A.yz}, Vec3<T>{A.xz, A.yz, A.zz}}};
  return inverse(M) * b;
}

template <typename T>
Vec3<T> solveJacobiSvd(const SymMat3<T>& A, const Vec3<T>& b) {
  Eigen::Matrix<T, 3, 3> M;
  M << A.xx, A.xy, A.xz, A.xy, A.yy, A.yz, A.xz, A.yz, A.zz;
  Eigen::JacobiSVD<Eigen::Matrix<T, 3, 3>> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix<T, 3, 1> x = svd.solve(Eigen::Matrix<T, 3, 1>(b.x, b.y, b.z));
  return {x[0], x[1], x[2]};
}

/// Measures one row: systems with eigenvalues 1, between, and 1/condition in random frames. The reference solves the
/// rounded system.
template <typename T>
void printConditionRow(RandomGeometry& random, double condition) {
  Errors ldlt, cramer, svd;
  for (int i = 0; i < kSystems / kDecades; ++i) {
    const auto D = SymMat3<double>{1, 0, 0, std::pow(condition, -random.uniform(0, 1)), 0, 1 / condition};
    const auto M = congruence(D, random.rotation());
    const auto cast = [](double v) { return static_cast<T>(v); };
    const SymMat3<T> A{cast(M.xx), cast(M.xy), cast(M.xz), cast(M.yy), cast(M.yz), cast(M.zz)};
    const Vec3<T> b = vecCast<T>(random.point());
    const auto exact = solveLdlt(SymMat3<long double>{A.xx, A.xy, A.xz, A.yy, A.yz, A.zz}, vecCast<long double>(b));
    if (!exact) {  // Rounding has made it indefinite.
      ++ldlt.declined;
      continue;
    }
    const auto error = [&](const Vec3<T>& x) {
      return static_cast<double>(length(vecCast<long double>(x) - *exact) / length(*exact));
    };
    if (const auto x = solveLdlt(A, b))
      ldlt.relative.push_back(error(*x));
    else
      ++ldlt.declined;
    cramer.relative.push_back(error(solveCramer(A, b)));
    svd.relative.push_back(error(solveJacobiSvd(A, b)));
  }
  const auto l = ldlt.medianAndLargest(), c = cramer.medianAndLargest(), s = svd.medianAndLargest();
  std::printf("| %s | %.0e | %.1e | %.1e | %.1f %% | %.1e | %.1e | %.1e | %.1e |\n",
              sizeof(T) == 4 ? "float" : "double", condition, l[0], l[1], 100.0 * ldlt.declined / (kSystems / kDecades),
              c[0], c[1], s[0], s[1]);
}

void printConditionTable() {
  std::puts(
      "| scalar | condition | LDLT median | LDLT worst | LDLT declines | Cramer median | Cramer worst | SVD median | "
      "SVD worst |\n|---|---|---|---|---|---|---|---|---|");
  RandomGeometry random(1);
  for (int decade = 1; decade <= kDecades; ++decade) printConditionRow<float>(random, std::pow(10, decade));
  for (int decade = 1; decade <= kDecades; ++decade) printConditionRow<double>(random, std::pow(10, decade));
}

/// Three triangles of unit size about `origin`, minimised with positions relative to `frame`.
template <typename T, typename F>
Vec3d minimiser(const std::array<Vec3d, 9>& corner, const Vec3d& origin, const Vec3d& frame, const F& quadric) {
  auto f = Quadric<T>::zero();
  for (std::size_t i = 0; i < 9; i += 3) {
    const auto local = [&](std::size_t k) { return vecCast<T>(origin + corner[i + k] - frame); };
    f += quadric(local(0), local(1), local(2));
  }
  const auto x = solveLdlt(f.A, f.b);
  return x ? vecCast<double>(*x) + (frame - origin) : Vec3d{INFINITY, INFINITY, INFINITY};
}

void printFrameTable() {
  std::puts(
      "\n| distance / size | local frame, worst | scene's frame, median | scene's frame, worst or no solution |\n"
      "|---|---|---|---|");
  const auto differences = [](auto p, auto q, auto r) {
    return probabilisticTriangleQuadric(p, q, r, decltype(p.x)(0.3));
  };
  const auto printed = [](auto p, auto q, auto r) { return globalFrameTriangleQuadric(p, q, r, decltype(p.x)(0.3)); };
  RandomGeometry random(2);
  for (const double distance : {10.0, 1e3, 1e5, 1e7}) {
    Errors local, global;
    for (int i = 0; i < 10'000; ++i) {
      const Vec3d origin = random.direction() * distance;
      std::array<Vec3d, 9> corner;
      for (std::size_t k = 0; k < 9; k += 3) {
        corner[k] = random.point() * 0.3;
        corner[k + 1] = corner[k] + random.direction();
        corner[k + 2] = corner[k] + random.direction();
      }
      const Vec3d exact = minimiser<double>(corner, origin, origin, differences);
      local.relative.push_back(length(minimiser<float>(corner, origin, origin, differences) - exact));
      global.relative.push_back(length(minimiser<float>(corner, origin, Vec3d{}, printed) - exact));
    }
    std::printf("| %.0e | %.1e | %.1e | %.1e |\n", distance, local.medianAndLargest()[1], global.medianAndLargest()[0],
                global.medianAndLargest()[1]);
  }
}

}  // namespace

int main() {
  printConditionTable();
  printFrameTable();
}
