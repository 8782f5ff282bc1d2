#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include "sample/dense/stored_scalars.h"
#include "sample/stencils/value_reading.h"

/// What decides about values, as bounds in their own type: what a value means never decreases, or never increases, with
/// the stored number, in floating point too.
namespace pdc::detail {

/// Keys from `low` to `high`; none if low > high.
template <typename Key>
struct KeyRange {
  Key low = 1, high = 0;

  [[nodiscard]] bool empty() const { return low > high; }
  /// False for NaN.
  [[nodiscard]] bool holds(Key k) const { return (k >= low) & (k <= high); }
};

/// The keys of a scalar by number, ascending, without NaN.
template <typename Scalar>
struct KeyOrder {
  using Key = typename Scalar::Key;
  using Signed =
      std::make_signed_t<std::conditional_t<sizeof(Key) == 8, std::uint64_t,
                                            std::conditional_t<sizeof(Key) == 4, std::uint32_t, std::uint16_t>>>;

  /// The order's number of positive infinity, counted from zero, or that of the largest key.
  static constexpr std::uint64_t last() {
    if constexpr (std::is_floating_point_v<Key>) {
      return 2 * (std::bit_cast<std::make_unsigned_t<Signed>>(std::numeric_limits<Key>::infinity()) +
                  std::uint64_t{1}) -
             1;
    } else if constexpr (std::is_same_v<Scalar, HalfScalar>) {
      return 2 * 0x7C01 - 1;
    } else {
      return static_cast<std::uint64_t>(std::numeric_limits<Key>::max()) -
             static_cast<std::uint64_t>(std::numeric_limits<Key>::lowest());
    }
  }
  static Key key(std::uint64_t i) {
    if constexpr (std::is_floating_point_v<Key>) {
      const auto ordered = static_cast<Signed>(i - (last() + 1) / 2);
      constexpr int kSign = 8 * sizeof(Key) - 1;
      return std::bit_cast<Key>(static_cast<Signed>(ordered ^ (ordered >> kSign & std::numeric_limits<Signed>::max())));
    } else if constexpr (std::is_same_v<Scalar, HalfScalar>) {
      return static_cast<Key>(static_cast<int>(i) - 0x7C01);
    } else {
      return static_cast<Key>(static_cast<std::uint64_t>(std::numeric_limits<Key>::lowest()) + i);
    }
  }
};

/// The keys for which `place`, which never decreases along them, is -1, 0 and 1.
template <typename Key>
struct KeysByPlace {
  KeyRange<Key> below, at, above;
};
template <typename Scalar, typename Place>
KeysByPlace<typename Scalar::Key> partKeys(const Place& place) {
  using Order = KeyOrder<Scalar>;
  constexpr std::uint64_t kLast = Order::last();
  const auto first = [&](int least) -> std::optional<std::uint64_t> {
    if (place(Order::key(kLast)) < least) return std::nullopt;
    std::uint64_t low = 0, high = kLast;
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      if (place(Order::key(middle)) >= least) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  };
  const std::optional<std::uint64_t> at = first(0), above = first(1);
  KeysByPlace<typename Scalar::Key> parts;
  if (!at || *at > 0) parts.below = {Order::key(0), Order::key(at ? *at - 1 : kLast)};
  if (at && (!above || *above > *at)) parts.at = {Order::key(*at), Order::key(above ? *above - 1 : kLast)};
  if (above) parts.above = {Order::key(*above), Order::key(kLast)};
  return parts;
}

/// Which stored values are finite, inside, and on the isovalue.
template <typename Scalar>
struct ValueBounds {
  using Key = typename Scalar::Key;

  KeyRange<Key> finite, inside, onIso;

  ValueBounds(double slope, double intercept, const ValueReading& reading) {
    const double sign = slope > 0 ? 1 : -1;
    const auto meaning = [&](Key k) { return slope * static_cast<double>(Scalar::number(Scalar::raw(k))) + intercept; };
    const auto order = [&](double v) { return static_cast<int>(sign * ((v > 0) - (v < 0))); };
    finite = partKeys<Scalar>([&](Key k) {
               const double v = meaning(k);
               return std::isfinite(v) ? 0 : order(v);
             }).at;
    const auto parts = partKeys<Scalar>([&](Key k) {
      const double v = meaning(k);
      return order((v > reading.iso) - (v < reading.iso));
    });
    onIso = within(parts.at);
    inside = within(reading.insideIsHigher == (slope > 0) ? parts.above : parts.below);
  }

 private:
  [[nodiscard]] KeyRange<Key> within(const KeyRange<Key>& r) const {
    if (r.empty() || finite.empty()) return {};
    return {r.low > finite.low ? r.low : finite.low, r.high < finite.high ? r.high : finite.high};
  }
};

}  // namespace pdc::detail
