#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "pdc/sample/dense/volume_view.h"

/// The types of stored values. Each has `Raw`, what lies in memory; `Key`, which orders values as their numbers are;
/// and `number`, which is what a raw value stands for. NaN has no place in the order.
namespace pdc::detail {

template <typename T>
struct PlainScalar {
  using Raw = T;
  using Key = T;
  static Key key(Raw raw) { return raw; }
  static Raw raw(Key key) { return key; }
  static T number(Raw raw) { return raw; }
};

struct BoolScalar {
  using Raw = std::uint8_t;
  using Key = std::uint8_t;
  static Key key(Raw raw) { return raw; }
  static Raw raw(Key key) { return key; }
  static std::uint8_t number(Raw raw) { return raw != 0; }
};

/// IEEE 754 binary16, without the instructions that not all processors have.
struct HalfScalar {
  using Raw = std::uint16_t;
  using Key = std::int16_t;
  static Key key(Raw raw) {
    const auto bits = static_cast<std::int16_t>(raw);
    return static_cast<std::int16_t>(bits ^ (bits >> 15 & 0x7FFF));
  }
  static Raw raw(Key key) { return static_cast<Raw>(key ^ (key >> 15 & 0x7FFF)); }
  static float number(Raw raw) {
    constexpr std::uint32_t kExponent = 0x7C00;
    // Moves the exponent's bias by a multiplication, which makes subnormal numbers normal, too.
    const float size = std::bit_cast<float>((raw & std::uint32_t{0x7FFF}) << 13) * 0x1p112F;
    const std::uint32_t special = (raw & kExponent) == kExponent ? 0x7F800000U : 0U;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(size) | special | (raw & std::uint32_t{0x8000}) << 16);
  }
};

/// Calls visit() with the scalar of a type; \returns what it does.
template <typename Visit>
auto visitScalar(ScalarType type, Visit&& visit) {
  switch (type) {
    case ScalarType::kBool:
      return visit(BoolScalar());
    case ScalarType::kInt8:
      return visit(PlainScalar<std::int8_t>());
    case ScalarType::kUint8:
      return visit(PlainScalar<std::uint8_t>());
    case ScalarType::kInt16:
      return visit(PlainScalar<std::int16_t>());
    case ScalarType::kUint16:
      return visit(PlainScalar<std::uint16_t>());
    case ScalarType::kInt32:
      return visit(PlainScalar<std::int32_t>());
    case ScalarType::kUint32:
      return visit(PlainScalar<std::uint32_t>());
    case ScalarType::kInt64:
      return visit(PlainScalar<std::int64_t>());
    case ScalarType::kUint64:
      return visit(PlainScalar<std::uint64_t>());
    case ScalarType::kFloat16:
      return visit(HalfScalar());
    case ScalarType::kFloat32:
      return visit(PlainScalar<float>());
    case ScalarType::kFloat64:
      break;
  }
  return visit(PlainScalar<double>());
}

/// A value with its bytes in the other order.
template <typename Raw>
Raw swapBytes(Raw value) {
  if constexpr (sizeof(Raw) == 1) {
    return value;
  } else if constexpr (sizeof(Raw) == 2) {
    return std::bit_cast<Raw>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  } else if constexpr (sizeof(Raw) == 4) {
    return std::bit_cast<Raw>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  } else {
    return std::bit_cast<Raw>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  }
}

/// Values that lie in memory, from one on, evenly spaced along a line.
template <typename Raw>
struct StoredLine {
  const std::byte* from;
  std::int64_t step;  ///< Bytes.
  bool swapped;

  [[nodiscard]] Raw operator[](std::int64_t i) const {
    Raw value;
    std::memcpy(&value, from + i * step, sizeof value);
    return swapped ? swapBytes(value) : value;
  }
  /// True if the values can be copied as they lie.
  [[nodiscard]] bool plain() const { return step == sizeof(Raw) && (!swapped || sizeof(Raw) == 1); }
  /// Copies `count` values. Always inlined, so that a constant count makes a few loads of it.
  [[gnu::always_inline]] void copy(std::int64_t count, Raw* to) const {
    if (plain()) {
      std::memcpy(to, from, static_cast<std::size_t>(count) * sizeof(Raw));
    } else if (step == sizeof(Raw)) {
      std::memcpy(to, from, static_cast<std::size_t>(count) * sizeof(Raw));
      for (std::int64_t i = 0; i < count; ++i) to[i] = swapBytes(to[i]);
    } else {
      for (std::int64_t i = 0; i < count; ++i) to[i] = (*this)[i];
    }
  }
};

}  // namespace pdc::detail
