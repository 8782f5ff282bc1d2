#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "pdc/error.h"

namespace pdc::detail {

/// How many values are not finite, and the one at the lowest place, by x, then y, then z.
template <typename Place>
struct NonFinite {
  std::size_t count = 0;
  Place first{};
  double value = 0;

  void add(const Place& at, double v) { add({1, at, v}); }
  void add(const NonFinite& o) {
    if (o.count == 0) return;
    if (count == 0 || o.first < first) {
      first = o.first;
      value = o.value;
    }
    count += o.count;
  }
};

/// A kind of thing that has a value, as errors call it.
struct ValueHolder {
  const char* one;
  const char* many;
};

/// \throws Error that says so of `count` things, one of them at `first`, and names the option that accepts them.
[[noreturn]] inline void failNonFinite(std::size_t count, const ValueHolder& things, const std::string& first,
                                       double value) {
  constexpr auto kRemedy = "--nan outside (acceptNonFinite in C++) takes such values as outside";
  const std::string what = std::isnan(value) ? "nan" : fmt::format("{}", value);
  if (count == 1) throw Error(fmt::format("1 {} is not finite: at {} it is {}; {}", things.one, first, what, kRemedy));
  throw Error(fmt::format("{} {} are not finite, the first at {} is {}; {}", count, things.many, first, what, kRemedy));
}

}  // namespace pdc::detail
