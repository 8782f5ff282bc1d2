#pragma once

#include <algorithm>
#include <cmath>

#include "pdc/field/field.h"

namespace pdc::detail {

/// Relative step h: the cube root of the rounding error, where the errors of a central difference, proportional to h²
/// for the series and to 1/h for rounding, add up to least.
inline constexpr double kDifferenceStep = 6.0554544523933429e-6;
/// Smaller coordinates count as this large, so that a step remains at the origin.
inline constexpr double kSmallestCoordinate = 1e-3;

/// Gradients by central differences along each axis. The step depends on the point alone, so that results do not depend
/// on the batch. \param evaluate evaluate(points, values) computes a batch of values.
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
