#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "io/file/suffix.h"
#include "io/volume/header_text.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc {
namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::optional<ScalarType> typeNamed(std::string_view name) {
  static const std::map<std::string_view, ScalarType> kTypes{
      {"u8", ScalarType::kUint8},    {"i8", ScalarType::kInt8},    {"u16", ScalarType::kUint16},
      {"i16", ScalarType::kInt16},   {"u32", ScalarType::kUint32}, {"i32", ScalarType::kInt32},
      {"u64", ScalarType::kUint64},  {"i64", ScalarType::kInt64},  {"f16", ScalarType::kFloat16},
      {"f32", ScalarType::kFloat32}, {"f64", ScalarType::kFloat64}};
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

RawVolume parseRawVolume(std::string_view text) {
  const auto refuse = [&] {
    return Error(fmt::format("\"{}\" is no layout like 256x256x128:u16be or 64x64x64:f32:256, with bytes to skip",
                             detail::oneLine(text)));
  };
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() < 2 || parts.size() > 3) throw refuse();
  RawVolume raw;
  const std::vector<std::string_view> sizes = split(parts[0], 'x');
  if (sizes.size() != 3) throw refuse();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto size = detail::TextScanner::parse<std::int64_t>(sizes[axis]);
    if (!size || *size < 1) throw refuse();
    raw.size[axis] = *size;
  }
  std::string_view type = parts[1];
  raw.bigEndian = type.ends_with("be");
  if (type.ends_with("be") || type.ends_with("le")) type.remove_suffix(2);
  const auto known = typeNamed(type);
  const auto skip =
      parts.size() < 3 ? std::optional<std::uint64_t>(0) : detail::TextScanner::parse<std::uint64_t>(parts[2]);
  if (!known || !skip) throw refuse();
  raw.type = *known;
  raw.skip = *skip;
  return raw;
}

namespace detail {

VolumeHeader describeRaw(const std::filesystem::path& path, const RawVolume& raw) {
  VolumeHeader header;
  header.volume.format = "raw";
  header.volume.view.type = raw.type;
  std::vector<MemoryAxis> axes;
  for (int i = 0; i < 3; ++i) axes.push_back({raw.size[static_cast<std::size_t>(i)], i});
  layOut(axes, {}, header);
  setByteOrder(raw.bigEndian, header);
  noteNoSpacing(header.volume);
  header.data.skip = raw.skip;
  header.data.encoding = suffixOf(path) == ".gz" ? VolumeEncoding::kDeflated : VolumeEncoding::kRaw;
  header.data.pieces = {{path}};
  return header;
}

}  // namespace detail
}  // namespace pdc
