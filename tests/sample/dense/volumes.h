#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/sample/dense/dense_source.h"

namespace pdc::test {

/// A volume with its memory. Copies look at their own memory only after view() is asked again.
struct Volume {
  std::vector<std::byte> bytes;
  VolumeView form;  ///< But for its data.
  std::int64_t first = 0;

  [[nodiscard]] VolumeView view() const {
    VolumeView v = form;
    v.data = bytes.data() + first;
    return v;
  }
};

/// How values lie in memory.
struct Layout {
  std::array<int, 3> order{0, 1, 2};  ///< Axes from the one with the largest stride to that with the smallest.
  std::array<bool, 3> reversed{};
  std::int64_t gap = 1;  ///< Values from one to the next.
  bool swapped = false;
};

template <typename T>
inline constexpr ScalarType kTypeOf = ScalarType::kFloat32;
template <>
inline constexpr ScalarType kTypeOf<double> = ScalarType::kFloat64;
template <>
inline constexpr ScalarType kTypeOf<std::int8_t> = ScalarType::kInt8;
template <>
inline constexpr ScalarType kTypeOf<std::uint8_t> = ScalarType::kUint8;
template <>
inline constexpr ScalarType kTypeOf<std::int16_t> = ScalarType::kInt16;
template <>
inline constexpr ScalarType kTypeOf<std::uint16_t> = ScalarType::kUint16;
template <>
inline constexpr ScalarType kTypeOf<std::int32_t> = ScalarType::kInt32;
template <>
inline constexpr ScalarType kTypeOf<std::uint32_t> = ScalarType::kUint32;
template <>
inline constexpr ScalarType kTypeOf<std::int64_t> = ScalarType::kInt64;
template <>
inline constexpr ScalarType kTypeOf<std::uint64_t> = ScalarType::kUint64;
template <>
inline constexpr ScalarType kTypeOf<bool> = ScalarType::kBool;

using Size = std::array<std::int64_t, 3>;
using Value = std::function<double(std::int64_t, std::int64_t, std::int64_t)>;

template <typename T>
Volume makeVolume(const Size& size, const Value& value, const Layout& layout = {}) {
  Volume volume;
  volume.form = {.type = kTypeOf<T>, .swapped = layout.swapped, .size = size};
  std::int64_t step = layout.gap * static_cast<std::int64_t>(sizeof(T));
  for (int i = 2; i >= 0; --i) {
    const int axis = layout.order[i];
    volume.form.stride[axis] = layout.reversed[axis] ? -step : step;
    if (layout.reversed[axis]) volume.first += step * (size[axis] - 1);
    step *= size[axis];
  }
  volume.bytes.resize(static_cast<std::size_t>(step));
  for (std::int64_t x = 0; x < size[0]; ++x)
    for (std::int64_t y = 0; y < size[1]; ++y)
      for (std::int64_t z = 0; z < size[2]; ++z) {
        const T v = static_cast<T>(value(x, y, z));
        std::byte* to = volume.bytes.data() + volume.first + volume.form.stride[0] * x + volume.form.stride[1] * y +
                        volume.form.stride[2] * z;
        std::memcpy(to, &v, sizeof v);
        if (layout.swapped) std::reverse(to, to + sizeof v);
      }
  return volume;
}

/// Distance from a sphere.
inline Value sphere(double x, double y, double z, double radius) {
  return [=](std::int64_t i, std::int64_t j, std::int64_t k) {
    return std::hypot(double(i) - x, double(j) - y, double(k) - z) - radius;
  };
}

inline LatticeMap unitMap() { return {Mat3d::identity(), {}}; }

inline bool sameBytes(const Mesh& a, const Mesh& b) {
  const auto same = [](const auto& p, const auto& q) {
    return p.size() == q.size() && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof(p[0])) == 0);
  };
  return same(a.positions, b.positions) && same(a.quads, b.quads) && same(a.triangles, b.triangles);
}

}  // namespace pdc::test
