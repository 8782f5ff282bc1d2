#pragma once

#include <cmath>
#include <cstddef>

#include "pdc/math/quadric.h"

/// Probabilistic quadrics of any distribution, by Monte Carlo (Trettner & Kobbelt 2020, section 3.4).
namespace pdc {

/// An estimate of an expected quadric.
template <typename T>
struct SampledQuadric {
  Quadric<T> mean;
  Quadric<T> standardError;  ///< One for each of the ten scalars of `mean`; zero for fewer than two samples.
};

namespace detail {

/// The quadric whose ten scalars are f of those of p and q.
template <typename T, typename F>
constexpr Quadric<T> entrywise(const Quadric<T>& p, const Quadric<T>& q, const F& f) {
  const SymMat3<T>&a = p.A, &b = q.A;
  return {{f(a.xx, b.xx), f(a.xy, b.xy), f(a.xz, b.xz), f(a.yy, b.yy), f(a.yz, b.yz), f(a.zz, b.zz)},
          {f(p.b.x, q.b.x), f(p.b.y, q.b.y), f(p.b.z, q.b.z)},
          f(p.c, q.c)};
}

}  // namespace detail

/// The mean of `count` quadrics drawn one after the other from `sample()`, on the calling thread: an estimate of the
/// expected quadric (equation 16), whose error falls with the square root of count. Zero for count = 0. Allocates
/// nothing; the same draws give the same bits. NaN in a draw becomes NaN in the mean, and what `sample` throws passes
/// through. \param sample returns a Quadric<T>; T = double unless the quadrics are few.
template <typename Sample>
auto sampleExpectedQuadric(std::size_t count, Sample&& sample) {
  using Result = decltype(sample());
  using T = decltype(Result::c);
  // Welford's recurrence, because sums of squares would cancel.
  Result mean = Result::zero(), squares = Result::zero();
  for (std::size_t k = 1; k <= count; ++k) {
    const Result x = sample();
    const Result before = x - mean;
    mean += before * (T(1) / static_cast<T>(k));
    squares += detail::entrywise(before, x - mean, [](T a, T b) { return a * b; });
  }
  const T scale = count < 2 ? T(0) : 1 / (static_cast<T>(count) * static_cast<T>(count - 1));
  return SampledQuadric<T>{mean, detail::entrywise(squares, squares, [scale](T a, T) { return std::sqrt(a * scale); })};
}

}  // namespace pdc
