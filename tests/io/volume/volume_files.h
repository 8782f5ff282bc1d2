#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"
#include "pdc/io/volume/volume_reader.h"

namespace pdc {

/// The bytes of a number, turned around where they are to be big-endian.
template <typename Number>
std::string bytesOf(Number number, bool bigEndian = false) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  if (bigEndian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// What each test volume holds at a point.
inline int rampAt(std::int64_t x, std::int64_t y, std::int64_t z) { return static_cast<int>(x + 5 * y + 25 * z); }

inline constexpr std::array<std::int64_t, 3> kRampSize{5, 4, 3};

/// The ramp's values with x running fastest.
template <typename Number>
std::string rampBytes(bool bigEndian = false) {
  std::string bytes;
  for (std::int64_t z = 0; z < kRampSize[2]; ++z)
    for (std::int64_t y = 0; y < kRampSize[1]; ++y)
      for (std::int64_t x = 0; x < kRampSize[0]; ++x) bytes += bytesOf(static_cast<Number>(rampAt(x, y, z)), bigEndian);
  return bytes;
}

template <typename Number>
double valueAt(const VolumeView& view, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::array<std::byte, sizeof(Number)> raw;
  std::memcpy(raw.data(), view.data + view.stride[0] * x + view.stride[1] * y + view.stride[2] * z, raw.size());
  if (view.swapped) std::reverse(raw.begin(), raw.end());
  Number number;
  std::memcpy(&number, raw.data(), raw.size());
  return view.slope * static_cast<double>(number) + view.intercept;
}

/// Expects the ramp, or `scale` times it plus `shift`.
template <typename Number>
void expectRamp(const DenseVolume& volume, double scale = 1, double shift = 0) {
  ASSERT_EQ(volume.view.size, kRampSize);
  ASSERT_EQ(sizeOf(volume.view.type), sizeof(Number));
  for (std::int64_t z = 0; z < kRampSize[2]; ++z)
    for (std::int64_t y = 0; y < kRampSize[1]; ++y)
      for (std::int64_t x = 0; x < kRampSize[0]; ++x)
        ASSERT_EQ(valueAt<Number>(volume.view, x, y, z), scale * rampAt(x, y, z) + shift) << x << ' ' << y << ' ' << z;
}

inline Vec3d placeOf(const DenseVolume& volume, const Vec3d& index) {
  return volume.linear * index + volume.translation;
}

inline void expectNear(const Vec3d& a, const Vec3d& b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// \param bits of zlib's window: 31 for gzip, 15 for zlib, -15 for neither.
inline std::string deflated(const std::string& bytes, int bits = 31) {
  z_stream stream{};
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, bits, 8, Z_DEFAULT_STRATEGY);
  std::string out(bytes.size() + 1024, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

/// What readVolume() complains of; empty if it does not.
inline std::string errorOfReading(const std::filesystem::path& path, const VolumeReadOptions& options = {}) {
  try {
    static_cast<void>(readVolume(path, options));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline bool mentions(const std::vector<std::string>& lines, std::string_view text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

}  // namespace pdc
