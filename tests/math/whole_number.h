#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

namespace pdc {

using Integer = boost::multiprecision::cpp_int;

inline constexpr int kWholeBits = 400;

/// 2^kWholeBits x: a whole number for multiples of 2^-kWholeBits, and so for all coordinates for which the predicates
/// promise to be exact.
inline Integer whole(double x) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53 + kWholeBits;
  if (mantissa == 0) return 0;
  return shift >= 0 ? Integer(mantissa) << shift : Integer(mantissa) / (Integer(1) << -shift);
}

inline int signOf(const Integer& i) { return i > 0 ? 1 : i < 0 ? -1 : 0; }

}  // namespace pdc
