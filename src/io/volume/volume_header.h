#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "io/volume/volume_data.h"
#include "pdc/io/volume/volume_reader.h"

namespace pdc::detail {

/// What the header of a volume says. All of `volume` is known but for the view's data and the owner.
struct VolumeHeader {
  DenseVolume volume;
  VolumeData data;
  LoadedBytes loaded{};     ///< The decoded bytes where a library has decoded them; else `data` says where they are.
  std::uint64_t first = 0;  ///< Where point (0, 0, 0) is in the decoded bytes.
};

// Readers of headers, one for each format. Errors do not name the file.

[[nodiscard]] VolumeHeader readNiftiHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader readNrrdHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader readMetaImageHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader readNpyHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader readNpzHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader readInrimageHeader(const std::filesystem::path& path, const VolumeReadOptions& options);
[[nodiscard]] VolumeHeader describeRaw(const std::filesystem::path& path, const RawVolume& raw);

/// What the first bytes of an array in NumPy's format say. \param rest all bytes of the array that are at hand, of
/// which the header must be among. `data.skip` is the header's size. \throws Error, also for other than three
/// dimensions.
[[nodiscard]] VolumeHeader parseNpyHeader(std::string_view rest);

/// An axis of an array that runs faster than those that follow it.
struct MemoryAxis {
  std::int64_t size = 0;
  /// 0 to 2: x, y or z. kChannel, kVolume: what is chosen from.
  int role = 0;
  static constexpr int kChannel = 3, kVolume = 4;
};

/// Sets size, strides, the first point and the number of bytes from the axes in memory, fastest first, and the type,
/// which is in `header.volume.view`. Chooses channel and volume as the options say. \throws Error for sizes below 1,
/// products beyond 2^63, choices that are not there or not made.
void layOut(std::span<const MemoryAxis> axes, const VolumeReadOptions& options, VolumeHeader& header);

/// A regular spacing: absolute values, and 1 instead of 0 and what is not finite. Adds warnings, unless nothing was
/// changed. \param source where the spacing stands.
[[nodiscard]] Vec3d regularSpacing(const Vec3d& spacing, std::string_view source, DenseVolume& volume);

/// Notes that the file has no spacing.
void noteNoSpacing(DenseVolume& volume);

/// Sets whether values are in the other byte order than this machine's.
void setByteOrder(bool bigEndian, VolumeHeader& header);

/// A number from the bytes at `offset`, whose order is the other than the machine's where `swapped`. The bytes must be
/// there.
template <typename Number>
[[nodiscard]] Number numberAt(std::string_view bytes, std::size_t offset, bool swapped) {
  std::array<char, sizeof(Number)> raw;
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = bytes[offset + (swapped ? raw.size() - 1 - i : i)];
  Number number;
  std::memcpy(&number, raw.data(), raw.size());
  return number;
}

/// The file that a header names, relative to the header's folder. \throws Error for an empty name.
[[nodiscard]] std::filesystem::path besideHeader(const std::filesystem::path& header, std::string_view name);

/// The file of number `number` by a pattern like slice%03d.raw. \throws Error for other patterns.
[[nodiscard]] std::filesystem::path patternFile(const std::filesystem::path& header, std::string_view pattern,
                                                std::int64_t number);

}  // namespace pdc::detail
