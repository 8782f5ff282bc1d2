#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pdc::detail {

/// A number as an unevaluated sum of doubles without common bits, the smallest first and none of them zero (Shewchuk
/// 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates). Operations are exact as
/// long as nothing overflows or underflows. They rely on every sum and product being rounded to nearest on its own, so
/// sources that use them are compiled without contraction.
template <std::size_t kCapacity>
struct Expansion {
  std::array<double, kCapacity> parts;
  std::size_t size = 0;

  void append(double part) {
    if (part != 0) parts[size++] = part;
  }
  [[nodiscard]] int sign() const { return size == 0 ? 0 : parts[size - 1] > 0 ? 1 : -1; }
};

/// A rounded result, and what rounding took away from it: the exact result is value + rest.
struct Rounded {
  double value, rest;
};

/// The sum of any two numbers.
inline Rounded twoSum(double a, double b) {
  const double sum = a + b;
  const double bPart = sum - a, aPart = sum - bPart;
  return {sum, (a - aPart) + (b - bPart)};
}

/// The sum of two numbers with |a| >= |b|.
inline Rounded fastTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Splits a number into two of at most 26 bits, whose products are exact.
inline Rounded split(double a) {
  const double c = 0x8000001p0 * a;
  const double high = c - (c - a);
  return {high, a - high};
}

/// The product of two numbers (Dekker).
inline Rounded twoProduct(double a, double b) {
  const double product = a * b;
  const Rounded as = split(a), bs = split(b);
  const double error = ((product - as.value * bs.value) - as.rest * bs.value) - as.value * bs.rest;
  return {product, as.rest * bs.rest - error};
}

inline Expansion<2> difference(double a, double b) {
  const Rounded d = twoSum(a, -b);
  Expansion<2> result;
  result.append(d.rest);
  result.append(d.value);
  return result;
}

template <std::size_t kN>
Expansion<kN> negated(Expansion<kN> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.parts[i] = -e.parts[i];
  return e;
}

/// The sum, by merging the parts by magnitude and carrying upwards: Shewchuk's FAST-EXPANSION-SUM with two-sums.
template <std::size_t kN, std::size_t kM>
Expansion<kN + kM> sum(const Expansion<kN>& e, const Expansion<kM>& f) {
  Expansion<kN + kM> result;
  std::size_t i = 0, j = 0;
  const auto smallest = [&] {
    const bool takeE = j == f.size || (i < e.size && std::abs(e.parts[i]) < std::abs(f.parts[j]));
    return takeE ? e.parts[i++] : f.parts[j++];
  };
  if (e.size + f.size == 0) return result;
  double carry = smallest();
  while (i < e.size || j < f.size) {
    const Rounded s = twoSum(carry, smallest());
    result.append(s.rest);
    carry = s.value;
  }
  result.append(carry);
  return result;
}

/// The product with a number: Shewchuk's SCALE-EXPANSION.
template <std::size_t kN>
Expansion<2 * kN> scaled(const Expansion<kN>& e, double factor) {
  Expansion<2 * kN> result;
  if (e.size == 0) return result;
  Rounded carry = twoProduct(e.parts[0], factor);
  result.append(carry.rest);
  for (std::size_t i = 1; i < e.size; ++i) {
    const Rounded product = twoProduct(e.parts[i], factor);
    const Rounded low = twoSum(carry.value, product.rest);
    result.append(low.rest);
    carry = fastTwoSum(product.value, low.value);
    result.append(carry.rest);
  }
  result.append(carry.value);
  return result;
}

/// The product with a factor of at most two parts, such as a difference of two numbers.
template <std::size_t kN>
Expansion<4 * kN> product(const Expansion<kN>& e, const Expansion<2>& factor) {
  Expansion<2 * kN> low, high;
  if (factor.size > 0) high = scaled(e, factor.parts[factor.size - 1]);
  if (factor.size > 1) low = scaled(e, factor.parts[0]);
  return sum(low, high);
}

}  // namespace pdc::detail
