#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pdc {

/// The type of the values of a dense volume.
enum class ScalarType : std::uint8_t {
  kBool,  ///< A byte; zero is false, anything else true.
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat16,  ///< IEEE 754 binary16.
  kFloat32,
  kFloat64,
};

/// Bytes of a value.
[[nodiscard]] constexpr std::size_t sizeOf(ScalarType type) {
  switch (type) {
    case ScalarType::kBool:
    case ScalarType::kInt8:
    case ScalarType::kUint8:
      return 1;
    case ScalarType::kInt16:
    case ScalarType::kUint16:
    case ScalarType::kFloat16:
      return 2;
    case ScalarType::kInt32:
    case ScalarType::kUint32:
    case ScalarType::kFloat32:
      return 4;
    case ScalarType::kInt64:
    case ScalarType::kUint64:
    case ScalarType::kFloat64:
      return 8;
  }
  return 0;
}

/// Values on all points of a box of the lattice, as they lie in memory that somebody else owns: of any type, byte order
/// and strides. Point (0, 0, 0) is the first; its value is at `data`, that of (x, y, z) `stride[0]·x + stride[1]·y +
/// stride[2]·z` bytes on. Values need no alignment.
struct VolumeView {
  const std::byte* data = nullptr;
  ScalarType type = ScalarType::kFloat32;
  bool swapped = false;                  ///< Bytes are in the other order than the machine's.
  std::array<std::int64_t, 3> size{};    ///< Points along x, y and z.
  std::array<std::int64_t, 3> stride{};  ///< Bytes from a point to the next along x, y and z; of any sign, or zero.
  /// What a stored value s means: slope · s + intercept. The slope is finite and not zero, the intercept finite.
  double slope = 1, intercept = 0;
};

}  // namespace pdc
