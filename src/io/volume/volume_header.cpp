#include "io/volume/volume_header.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "io/file/file_error.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// The product of sizes in bytes. \throws Error beyond 2^63.
std::int64_t checkedProduct(std::int64_t a, std::int64_t b) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) throw Error("the sizes are too large: more than 2^63 bytes");
  return product;
}

/// Which of `count` to take. \param what, option: how errors call it.
std::int64_t chosen(std::optional<std::int64_t> asked, std::int64_t count, const char* what, const char* option) {
  const std::int64_t index = asked.value_or(0);
  if (index < 0 || index >= count)
    throw Error(fmt::format("there is no {} {}: it has {} (see {})", what, index, count, option));
  return index;
}

std::int64_t chooseOn(const MemoryAxis& axis, const VolumeReadOptions& options, DenseVolume& volume) {
  if (axis.role == MemoryAxis::kVolume) {
    if (axis.size > 1 && !options.volumeIndex)
      volume.warnings.push_back(
          fmt::format("holds {} volumes, of which the first is taken; --volume-index takes another", axis.size));
    return chosen(options.volumeIndex, axis.size, "volume", "--volume-index");
  }
  if (axis.size > 1 && !options.channel)
    throw Error(fmt::format("has {} values a point; --channel takes one of them, 0 to {}", axis.size, axis.size - 1));
  return chosen(options.channel, axis.size, "channel", "--channel");
}

bool hasAxis(std::span<const MemoryAxis> axes, int role) {
  for (const MemoryAxis& axis : axes)
    if (axis.role == role) return true;
  return false;
}

}  // namespace

void layOut(std::span<const MemoryAxis> axes, const VolumeReadOptions& options, VolumeHeader& header) {
  VolumeView& view = header.volume.view;
  if (options.channel.value_or(0) != 0 && !hasAxis(axes, MemoryAxis::kChannel))
    throw Error("has one value a point; --channel does not go with it");
  if (options.volumeIndex.value_or(0) != 0 && !hasAxis(axes, MemoryAxis::kVolume))
    throw Error("holds one volume; --volume-index does not go with it");
  auto stride = static_cast<std::int64_t>(sizeOf(view.type));
  header.first = 0;
  for (const MemoryAxis& axis : axes) {
    if (axis.size < 1) throw Error(fmt::format("a size is {}; it must be at least 1", axis.size));
    if (axis.role < MemoryAxis::kChannel) {
      view.size[static_cast<std::size_t>(axis.role)] = axis.size;
      view.stride[static_cast<std::size_t>(axis.role)] = stride;
    } else {
      header.first += static_cast<std::uint64_t>(stride * chooseOn(axis, options, header.volume));
    }
    stride = checkedProduct(stride, axis.size);
  }
  header.data.bytes = static_cast<std::uint64_t>(stride);
  header.data.type = view.type;
}

Vec3d regularSpacing(const Vec3d& spacing, std::string_view source, DenseVolume& volume) {
  Vec3d regular;
  bool missing = false, negative = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double s = spacing[axis];
    const bool known = std::isfinite(s) && s != 0;
    missing = missing || !known;
    negative = negative || (known && s < 0);
    regular[axis] = known ? std::abs(s) : 1.0;
  }
  if (missing) volume.spacingKnown = false;
  if (missing)
    volume.warnings.push_back(
        fmt::format("{} is ({:.6g}, {:.6g}, {:.6g}); what is 0 or not finite was taken as 1; "
                    "--spacing says better",
                    source, spacing.x, spacing.y, spacing.z));
  else if (negative)
    volume.warnings.push_back(fmt::format("{} is ({:.6g}, {:.6g}, {:.6g}); its absolute values were taken", source,
                                          spacing.x, spacing.y, spacing.z));
  return regular;
}

void noteNoSpacing(DenseVolume& volume) {
  volume.spacingKnown = false;
  volume.warnings.push_back("says nothing of spacing; it was taken as 1; --spacing says better");
}

void setByteOrder(bool bigEndian, VolumeHeader& header) {
  header.volume.view.swapped =
      bigEndian != (std::endian::native == std::endian::big) && sizeOf(header.volume.view.type) > 1;
}

std::filesystem::path besideHeader(const std::filesystem::path& header, std::string_view name) {
  if (name.empty()) throw Error("the name of the data file is empty");
  if (name.find('\0') != std::string_view::npos) throw Error("the name of the data file has a zero in it");
  return header.parent_path() / std::filesystem::path(std::string(name));
}

std::filesystem::path patternFile(const std::filesystem::path& header, std::string_view pattern, std::int64_t number) {
  const std::size_t begin = pattern.find('%'), end = pattern.find('d', begin);
  const auto refuse = [&] {
    return Error(fmt::format("\"{}\" is no pattern of file names like f%03d.raw", oneLine(pattern)));
  };
  if (end == std::string_view::npos || end - begin > 4) throw refuse();
  const std::string_view format = pattern.substr(begin + 1, end - begin - 1);
  std::size_t width = 0;
  for (const char c : format) {
    if (c < '0' || c > '9') throw refuse();
    width = 10 * width + static_cast<std::size_t>(c - '0');
  }
  std::string digits = std::to_string(number);
  const char fill = format.starts_with('0') ? '0' : ' ';
  if (digits.size() < width) digits.insert(0, width - digits.size(), fill);
  return besideHeader(header, std::string(pattern.substr(0, begin)) + digits + std::string(pattern.substr(end + 1)));
}

}  // namespace pdc::detail
