#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string>
#include <vector>

#include "io/file/mapped_file.h"
#include "io/volume/header_text.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

ScalarType typeNamed(std::string_view name) {
  static const std::map<std::string_view, ScalarType> kTypes{
      {"b1", ScalarType::kBool},    {"i1", ScalarType::kInt8},    {"u1", ScalarType::kUint8},
      {"i2", ScalarType::kInt16},   {"u2", ScalarType::kUint16},  {"i4", ScalarType::kInt32},
      {"u4", ScalarType::kUint32},  {"i8", ScalarType::kInt64},   {"u8", ScalarType::kUint64},
      {"f2", ScalarType::kFloat16}, {"f4", ScalarType::kFloat32}, {"f8", ScalarType::kFloat64}};
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) throw Error(fmt::format("an array of type '{}' is not read", oneLine(name)));
  return found->second;
}

/// What follows 'key': in the dictionary, without blanks at its beginning. \throws Error if it is not there.
std::string_view valueOf(std::string_view dictionary, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = quote + std::string(key) + quote;
    const std::size_t found = dictionary.find(quoted);
    if (found == std::string_view::npos) continue;
    const std::string_view rest = trimmed(dictionary.substr(found + quoted.size()));
    if (rest.starts_with(':')) return trimmed(rest.substr(1));
  }
  throw Error(fmt::format("the array's header does not say '{}'", key));
}

void readType(std::string_view dictionary, VolumeHeader& header) {
  const std::string_view value = valueOf(dictionary, "descr");
  if (value.empty() || (value.front() != '\'' && value.front() != '"'))
    throw Error("an array of several fields is not read");
  const std::string_view name = value.substr(1, value.find(value.front(), 1) - 1);
  if (name.empty() || std::string_view("<>|=").find(name.front()) == std::string_view::npos)
    throw Error(fmt::format("an array of type '{}' is not read", oneLine(name.substr(0, 60))));
  header.volume.view.type = typeNamed(name.substr(1));
  setByteOrder(name.front() == '>' || (name.front() == '=' && std::endian::native == std::endian::big), header);
}

/// The sizes of a tuple like (3, 4, 5) or (3L,).
std::vector<std::int64_t> readShape(std::string_view dictionary) {
  const std::string_view value = valueOf(dictionary, "shape");
  const std::size_t end = value.find(')');
  if (!value.starts_with('(') || end == std::string_view::npos) throw Error("the array's shape is malformed");
  std::vector<std::int64_t> sizes;
  for (std::string_view rest = trimmed(value.substr(1, end - 1)); !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    std::string_view number = trimmed(rest.substr(0, comma));
    if (number.ends_with('L')) number.remove_suffix(1);
    sizes.push_back(numberIn<std::int64_t>(number, "shape"));
    rest = trimmed(rest.substr(std::min(comma + 1, rest.size())));
  }
  return sizes;
}

}  // namespace

VolumeHeader parseNpyHeader(std::string_view rest) {
  constexpr std::size_t kBegin = 12;  // Magic, version and, from version 2 on, four bytes of length
  if (rest.size() < kBegin || !rest.starts_with(kMagic))
    throw Error("not an array of NumPy: it does not begin with \\x93NUMPY");
  const bool swapped = std::endian::native != std::endian::little;
  const int version = static_cast<unsigned char>(rest[6]);
  if (version < 1 || version > 3) throw Error(fmt::format("version {} of NumPy's format is not read", version));
  const std::size_t begin = version == 1 ? 10 : 12;
  const std::size_t length =
      version == 1 ? numberAt<std::uint16_t>(rest, 8, swapped) : numberAt<std::uint32_t>(rest, 8, swapped);
  if (length > rest.size() - begin) throw Error("ends early: within the array's header");
  const std::string_view dictionary = rest.substr(begin, length);

  VolumeHeader header;
  readType(dictionary, header);
  std::vector<std::int64_t> shape = readShape(dictionary);
  if (shape.size() != 3) throw Error(fmt::format("the array has {} dimensions; a volume has 3", shape.size()));
  std::vector<MemoryAxis> axes;
  for (int i = 0; i < 3; ++i) axes.push_back({shape[static_cast<std::size_t>(i)], i});
  if (!valueOf(dictionary, "fortran_order").starts_with("True")) std::reverse(axes.begin(), axes.end());
  layOut(axes, {}, header);
  header.data.skip = begin + length;
  noteNoSpacing(header.volume);
  return header;
}

VolumeHeader readNpyHeader(const std::filesystem::path& path, const VolumeReadOptions& /*options*/) {
  const MappedFile file(path);
  VolumeHeader header = parseNpyHeader({file.bytes().data(), file.bytes().size()});
  header.volume.format = "npy";
  header.data.pieces = {{path}};
  return header;
}

}  // namespace pdc::detail
