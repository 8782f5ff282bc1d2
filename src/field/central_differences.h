#pragma once

#include <algorithm>
#include <cmath>

#include "pdc/field/field.h"

namespace pdc::detail {

/// The cube root of the rounding error: where the errors of a central difference, h² from the series and 1/h from
/// rounding, add up to least.
inline constexpr double kDifferenceStep = 6.0554544523933429e-6;
/// Coordinates below this count as this large, so that a step remains at the origin.
inline constexpr double kSmallestCoordinate = 1e-3;

/// Central differences along each axis. `evaluate(points, values)` computes a batch of values. The step depends on the
/// point alone.
template <typename Evaluate>
void centralDifferences(PointSpan points, const Evaluate& evaluate, GradientSpan gradients) {
  double upper[Field::kMaxBatch], lower[Field::kMaxBatch], atUpper[Field::kMaxBatch], atLower[Field::kMaxBatch];
  const double* coordinates[3] = {points.x, points.y, points.z};
  double* result[3] = {gradients.x, gradients.y, gradients.z};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size; ++i) {
      const double size = std::max(std::max(std::abs(points.x[i]), std::abs(points.y[i])),
                                   std::max(std::abs(points.z[i]), kSmallestCoordinate));
      upper[i] = coordinates[axis][i] + kDifferenceStep * size;
      lower[i] = coordinates[axis][i] - kDifferenceStep * size;
    }
    const auto along = [&](const double* moved) {
      return PointSpan{axis == 0 ? moved : points.x, axis == 1 ? moved : points.y, axis == 2 ? moved : points.z,
                       points.size};
    };
    evaluate(along(upper), atUpper);
    evaluate(along(lower), atLower);
    for (std::size_t i = 0; i < points.size; ++i) result[axis][i] = (atUpper[i] - atLower[i]) / (upper[i] - lower[i]);
  }
}

}  // namespace pdc::detail
