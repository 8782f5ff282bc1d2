#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "pdc/math/quadric.h"
#include "pdc/math/solvers.h"

/// Curves and surfaces between the minima of quadrics (Trettner & Kobbelt 2020, section 5.3): the quadrics are
/// interpolated, and the point is where the result is least. With probabilistic planes through the points to be met it
/// is sharp where σn is low, and the linear interpolation in the limit of high σn. It is the product of Gaussians with
/// the means q and the covariances (nnᵀ + Σn)⁻¹; see gaussian_product.h. Coordinates are those of a local frame, as in
/// quadric.h. All functions are pure.
namespace pdc {

/// The minimum of Σ wᵢ fᵢ. \param weights one for each quadric; a common factor of them changes nothing. \returns
/// nothing where the sum has no single minimum, which weights >= 0 that are not all 0 exclude for probabilistic
/// quadrics.
[[nodiscard]] constexpr std::optional<Vec3d> interpolate(std::span<const Quadric<double>> quadrics,
                                                         std::span<const double> weights) {
  NormalEquations<double> sum = NormalEquations<double>::zero();
  for (std::size_t i = 0; i < quadrics.size(); ++i) sum += (quadrics[i] * weights[i]).normalEquations();
  return solveLdlt(sum.A, sum.b);
}

/// The point at t in [0, 1] of the curve from the minimum of the first quadric to that of the second.
[[nodiscard]] constexpr std::optional<Vec3d> interpolateCurve(const std::array<Quadric<double>, 2>& ends, double t) {
  return interpolate(ends, std::array{1 - t, t});
}

/// The point of a patch between four quadrics, in order around it: at (u, v) = (0, 0), (1, 0), (1, 1) and (0, 1) it
/// meets their minima.
[[nodiscard]] constexpr std::optional<Vec3d> interpolateBilinear(const std::array<Quadric<double>, 4>& corners,
                                                                 double u, double v) {
  return interpolate(corners, std::array{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
}

/// The point of a triangular patch. \param coordinates barycentric, of sum 1.
[[nodiscard]] constexpr std::optional<Vec3d> interpolateBarycentric(const std::array<Quadric<double>, 3>& corners,
                                                                    const std::array<double, 3>& coordinates) {
  return interpolate(corners, coordinates);
}

}  // namespace pdc
