#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "io/deflate/inflate.h"
#include "io/file/mapped_file.h"
#include "io/file/suffix.h"
#include "io/volume/header_text.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

using Fields = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view kMagic = "#INRIMAGE-4#{", kEnd = "##}\n";
constexpr std::size_t kBlock = 256, kMostHeader = std::size_t{1} << 16;

std::string beginningOf(const std::filesystem::path& path) {
  const MappedFile file(path);
  const std::span<const char> bytes = file.bytes();
  std::string head(kMostHeader, '\0');
  if (suffixOf(path) == ".gz")
    head.resize(InflateStream(bytes).readSome(head.data(), head.size()));
  else
    head.assign(bytes.data(), std::min(bytes.size(), kMostHeader));
  return head;
}

std::string_view get(const Fields& fields, std::string_view name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string_view{} : std::string_view(found->second);
}

double realOf(const Fields& fields, std::string_view name, double otherwise) {
  const std::string_view text = get(fields, name);
  return text.empty() ? otherwise : numberIn<double>(text, name);
}

ScalarType typeOf(const Fields& fields) {
  const std::string type = lowerCase(get(fields, "TYPE"));
  const std::vector<std::string_view> size = wordsOf(get(fields, "PIXSIZE"));
  const auto bits = size.empty() ? std::int64_t{0} : numberIn<std::int64_t>(size[0], "PIXSIZE");
  static const std::map<std::pair<std::string_view, std::int64_t>, ScalarType> kTypes{
      {{"unsigned fixed", 8}, ScalarType::kUint8},   {{"unsigned fixed", 16}, ScalarType::kUint16},
      {{"unsigned fixed", 32}, ScalarType::kUint32}, {{"unsigned fixed", 64}, ScalarType::kUint64},
      {{"signed fixed", 8}, ScalarType::kInt8},      {{"signed fixed", 16}, ScalarType::kInt16},
      {{"signed fixed", 32}, ScalarType::kInt32},    {{"signed fixed", 64}, ScalarType::kInt64},
      {{"float", 32}, ScalarType::kFloat32},         {{"float", 64}, ScalarType::kFloat64}};
  const auto found = kTypes.find({type, bits});
  if (found == kTypes.end())
    throw Error(fmt::format("Inrimage values of type \"{}\" of {} bits are not read", oneLine(type), bits));
  return found->second;
}

/// CPU=decm, alpha and pc are little-endian machines; sun and sgi are big-endian ones.
bool isBigEndian(const Fields& fields) {
  const std::string cpu = lowerCase(get(fields, "CPU"));
  if (cpu == "sun" || cpu == "sgi") return true;
  if (cpu == "decm" || cpu == "alpha" || cpu == "pc") return false;
  throw Error(fmt::format("CPU=\"{}\" is not known: decm, alpha and pc are little-endian, sun and sgi big-endian",
                          oneLine(cpu)));
}

/// Numbers of fixed point are multiples of a power of two, "2**-3".
void takeScale(const Fields& fields, VolumeView& view) {
  const std::string_view text = get(fields, "SCALE");
  if (!text.starts_with("2**")) return;
  const auto exponent = numberIn<std::int32_t>(text.substr(3), "SCALE");
  constexpr int kMost = 64;
  if (std::abs(std::int64_t{exponent}) > kMost) throw Error(fmt::format("SCALE=2**{} is out of range", exponent));
  view.slope = std::ldexp(1.0, exponent);
}

}  // namespace

VolumeHeader readInrimageHeader(const std::filesystem::path& path, const VolumeReadOptions& options) {
  const std::string head = beginningOf(path);
  const std::size_t end = head.find(kEnd);
  if (!head.starts_with(kMagic) || end == std::string::npos)
    throw Error("not Inrimage: it has no header from #INRIMAGE-4#{ to ##}");
  Fields fields;
  TextScanner scanner(std::string_view(head).substr(kMagic.size(), end - kMagic.size()), '\0');
  while (scanner.nextLine()) {
    const std::string_view line = trimmed(scanner.wholeLine());
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos && !line.starts_with('#'))
      fields[std::string(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
  }

  VolumeHeader header;
  DenseVolume& volume = header.volume;
  volume.format = "Inrimage";
  volume.view.type = typeOf(fields);
  std::vector<MemoryAxis> axes;
  const auto channels =
      get(fields, "VDIM").empty() ? std::int64_t{1} : numberIn<std::int64_t>(get(fields, "VDIM"), "VDIM");
  if (channels != 1) axes.push_back({channels, MemoryAxis::kChannel});
  int role = 0;
  for (const char* const name : {"XDIM", "YDIM", "ZDIM"})
    axes.push_back({numberIn<std::int64_t>(get(fields, name), name), role++});
  layOut(axes, options, header);
  if (sizeOf(volume.view.type) > 1) setByteOrder(isBigEndian(fields), header);
  takeScale(fields, volume.view);
  if (get(fields, "VX").empty()) {
    noteNoSpacing(volume);
  } else {
    const Vec3d s = regularSpacing({realOf(fields, "VX", 1), realOf(fields, "VY", 1), realOf(fields, "VZ", 1)},
                                   "VX, VY, VZ", volume);
    volume.linear = Mat3d::diagonal(s.x, s.y, s.z);
    volume.orientation = "VX, VY, VZ";
  }
  volume.translation = {realOf(fields, "TX", 0), realOf(fields, "TY", 0), realOf(fields, "TZ", 0)};
  header.data.skip = (end + kEnd.size() + kBlock - 1) / kBlock * kBlock;
  header.data.encoding = suffixOf(path) == ".gz" ? VolumeEncoding::kDeflated : VolumeEncoding::kRaw;
  header.data.pieces = {{path}};
  return header;
}

}  // namespace pdc::detail
