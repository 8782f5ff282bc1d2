#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "pdc/field/field.h"

namespace pdc::detail {

/// Relative step h: the cube root of the rounding error, where the errors of a central difference, proportional to h²
/// for the series and to 1/h for rounding, add up to least.
inline constexpr double kDifferenceStep = 6.0554544523933429e-6;
/// Smaller coordinates count as this large, so that a step remains at the origin.
inline constexpr double kSmallestCoordinate = 1e-3;

/// Values, and gradients by central differences along each axis. The step depends on the point alone, so that results do
/// not depend on the batch. \param evaluate evaluate(points, values) computes values, here of all points that are needed
/// at once: up to seven times Field::kMaxBatch, since a call may cost more than its points.
template <typename Evaluate>
void centralDifferences(PointSpan points, const Evaluate& evaluate, double* values, GradientSpan gradients) {
  constexpr std::size_t kCopies = 7;  // The points, and for each axis one above and one below.
  std::array<double, kCopies * Field::kMaxBatch> x, y, z, value;
  const std::size_t n = points.size;
  for (std::size_t copy = 0; copy < kCopies; ++copy) {
    std::copy_n(points.x, n, &x[copy * n]);
    std::copy_n(points.y, n, &y[copy * n]);
    std::copy_n(points.z, n, &z[copy * n]);
  }
  double* const coordinates[3] = {x.data(), y.data(), z.data()};
  const auto upper = [n](int axis) { return (1 + 2 * static_cast<std::size_t>(axis)) * n; };
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < n; ++i) {
      const double size = std::max(std::max(std::abs(points.x[i]), std::abs(points.y[i])),
                                   std::max(std::abs(points.z[i]), kSmallestCoordinate));
      coordinates[axis][upper(axis) + i] += kDifferenceStep * size;
      coordinates[axis][upper(axis) + n + i] -= kDifferenceStep * size;
    }
  evaluate(PointSpan{x.data(), y.data(), z.data(), kCopies * n}, value.data());
  std::copy_n(value.data(), n, values);
  double* const result[3] = {gradients.x, gradients.y, gradients.z};
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t above = upper(axis) + i, below = above + n;
      result[axis][i] = (value[above] - value[below]) / (coordinates[axis][above] - coordinates[axis][below]);
    }
}

}  // namespace pdc::detail
