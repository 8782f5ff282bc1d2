#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pdc/math/expected_quadric.h"

namespace pdc {

/// The largest difference of an entry of A, b or c.
template <typename T>
double largestDifference(const Quadric<T>& p, const Quadric<T>& q) {
  double d = std::abs(static_cast<double>(p.c - q.c));
  for (int i = 0; i < 3; ++i) {
    d = std::max(d, std::abs(static_cast<double>(p.b[i] - q.b[i])));
    for (int j = 0; j <= i; ++j) d = std::max(d, std::abs(static_cast<double>(p.A(i, j) - q.A(i, j))));
  }
  return d;
}

/// Expects each of the ten scalars within five of its standard errors of `expected`, and the errors to be small enough
/// for that to mean something: below `resolution` times the largest scalar of A.
inline void expectIsTheMean(const SampledQuadric<double>& sampled, const Quadric<double>& expected, double resolution) {
  const auto near = [](double mean, double error, double value) {
    EXPECT_LE(std::abs(mean - value), 5 * error + 1e-12 * std::abs(value));
  };
  near(sampled.mean.c, sampled.standardError.c, expected.c);
  for (int i = 0; i < 3; ++i) {
    near(sampled.mean.b[i], sampled.standardError.b[i], expected.b[i]);
    for (int j = 0; j <= i; ++j) {
      near(sampled.mean.A(i, j), sampled.standardError.A(i, j), expected.A(i, j));
      EXPECT_LT(sampled.standardError.A(i, j), resolution * expected.A.trace());
    }
  }
}

}  // namespace pdc
