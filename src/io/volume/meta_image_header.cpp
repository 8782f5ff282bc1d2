#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "io/file/mapped_file.h"
#include "io/file/suffix.h"
#include "io/volume/header_text.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// The header's fields by their names in lower case, and what follows it.
struct MetaText {
  std::map<std::string, std::string, std::less<>> fields;
  std::size_t end = 0;  ///< Where the line of ElementDataFile, which is the last, ends.

  /// The first of these fields that is there.
  [[nodiscard]] std::string_view get(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
      if (const auto found = fields.find(name); found != fields.end()) return found->second;
    return {};
  }
  [[nodiscard]] bool flag(std::initializer_list<std::string_view> names, bool otherwise) const {
    const std::string value = lowerCase(get(names));
    return value.empty() ? otherwise : value.front() == 't' || value.front() == 'y' || value.front() == '1';
  }
};

MetaText readText(std::string_view bytes) {
  MetaText text;
  constexpr std::size_t kMostHeader = std::size_t{1} << 20;
  while (text.end < std::min(bytes.size(), kMostHeader)) {
    const std::size_t newline = std::min(bytes.find('\n', text.end), bytes.size());
    const std::string_view line = trimmed(bytes.substr(text.end, newline - text.end));
    text.end = std::min(newline + 1, bytes.size());
    if (line.empty() || line.starts_with('#')) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) break;
    const std::string name = lowerCase(trimmed(line.substr(0, equals)));
    text.fields[name] = trimmed(line.substr(equals + 1));
    if (name == "elementdatafile") return text;
  }
  throw Error("not MetaImage: the header has no line \"ElementDataFile = ...\"");
}

ScalarType typeNamed(std::string_view name) {
  static const std::map<std::string_view, ScalarType> kTypes{
      {"MET_CHAR", ScalarType::kInt8},       {"MET_UCHAR", ScalarType::kUint8},
      {"MET_SHORT", ScalarType::kInt16},     {"MET_USHORT", ScalarType::kUint16},
      {"MET_INT", ScalarType::kInt32},       {"MET_UINT", ScalarType::kUint32},
      {"MET_LONG", ScalarType::kInt32},      {"MET_ULONG", ScalarType::kUint32},
      {"MET_LONG_LONG", ScalarType::kInt64}, {"MET_ULONG_LONG", ScalarType::kUint64},
      {"MET_FLOAT", ScalarType::kFloat32},   {"MET_DOUBLE", ScalarType::kFloat64}};
  // Arrays are what files with several channels call their types.
  constexpr std::string_view kArray = "_ARRAY";
  if (name.ends_with(kArray)) name.remove_suffix(kArray.size());
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) throw Error(fmt::format("MetaImage values of type \"{}\" are not read", oneLine(name)));
  return found->second;
}

std::vector<MemoryAxis> axesOf(const MetaText& text) {
  const auto dimensions = numberIn<std::int64_t>(text.get({"ndims"}), "NDims");
  if (dimensions != 3 && dimensions != 4) throw Error(fmt::format("has {} dimensions; a volume has 3", dimensions));
  std::vector<MemoryAxis> axes;
  const std::string_view channels = text.get({"elementnumberofchannels"});
  if (!channels.empty())
    if (const auto count = numberIn<std::int64_t>(channels, "ElementNumberOfChannels"); count != 1)
      axes.push_back({count, MemoryAxis::kChannel});
  const auto sizes = numbersIn<std::int64_t>(text.get({"dimsize"}), "DimSize", static_cast<std::size_t>(dimensions));
  for (std::size_t i = 0; i < sizes.size(); ++i)
    axes.push_back({sizes[i], i < 3 ? static_cast<int>(i) : MemoryAxis::kVolume});
  return axes;
}

/// Rows of the matrix are the directions of the axes: it is the transpose of the one that acts on columns.
void place(const MetaText& text, std::size_t dimensions, DenseVolume& volume) {
  Vec3d spacing{1, 1, 1};
  if (const std::string_view said = text.get({"elementspacing", "elementsize"}); !said.empty()) {
    const std::vector<double> s = numbersIn<double>(said, "ElementSpacing", dimensions);
    spacing = regularSpacing({s[0], s[1], s[2]}, "ElementSpacing", volume);
  } else {
    noteNoSpacing(volume);
  }
  volume.linear = Mat3d::diagonal(spacing.x, spacing.y, spacing.z);
  if (const std::string_view said = text.get({"transformmatrix", "rotation", "orientation"}); !said.empty()) {
    const std::vector<double> m = numbersIn<double>(said, "TransformMatrix", dimensions * dimensions);
    for (int axis = 0; axis < 3; ++axis)
      for (int row = 0; row < 3; ++row)
        volume.linear.row[static_cast<std::size_t>(row)][axis] =
            spacing[axis] * m[static_cast<std::size_t>(axis) * dimensions + static_cast<std::size_t>(row)];
    volume.orientation = "TransformMatrix";
  } else if (volume.spacingKnown) {
    volume.orientation = "ElementSpacing";
  }
  if (const std::string_view said = text.get({"offset", "position", "origin"}); !said.empty()) {
    const std::vector<double> o = numbersIn<double>(said, "Offset", dimensions);
    volume.translation = {o[0], o[1], o[2]};
  }
  volume.space = "LPS";
  const std::string unit = lowerCase(text.get({"distanceunits"}));
  if (unit == "mm" || unit == "um" || unit == "cm" || unit == "m") volume.unit = unit;
}

/// The files of "LOCAL", "LIST", "NAME" or "PATTERN BEGIN END STEP".
std::vector<VolumePiece> filesOf(const std::filesystem::path& path, const MetaText& text, std::string_view bytes) {
  const std::string_view said = text.get({"elementdatafile"});
  const std::string lower = lowerCase(said);
  if (lower == "local") return {{path, text.end}};
  const std::vector<std::string_view> words = wordsOf(said);
  std::vector<VolumePiece> pieces;
  if (!words.empty() && lowerCase(words[0]) == "list") {
    if (words.size() > 1 && words[1] != "2" && words[1] != "2D" && words[1] != "3" && words[1] != "3D")
      throw Error(fmt::format("ElementDataFile: \"{}\" is not read", oneLine(said)));
    TextScanner scanner(bytes.substr(text.end), '\0');
    while (scanner.nextLine()) pieces.push_back({besideHeader(path, trimmed(scanner.wholeLine()))});
  } else if (words.size() >= 3 && words[0].find('%') != std::string_view::npos) {
    const auto begin = numberIn<std::int32_t>(words[1], "ElementDataFile"),
               end = numberIn<std::int32_t>(words[2], "ElementDataFile"),
               step = words.size() > 3 ? numberIn<std::int32_t>(words[3], "ElementDataFile") : 1;
    constexpr std::int64_t kMostFiles = 1 << 20;
    if (step < 1 || (std::int64_t{end} - begin) / step >= kMostFiles)
      throw Error(fmt::format("ElementDataFile: {} to {} in steps of {} are no numbers of files", begin, end, step));
    for (std::int64_t n = begin; n <= end; n += step) pieces.push_back({patternFile(path, words[0], n)});
  } else {
    pieces.push_back({besideHeader(path, said)});
  }
  if (pieces.empty()) throw Error("the header names no data files");
  return pieces;
}

void placeData(const std::filesystem::path& path, const MetaText& text, std::string_view bytes, VolumeHeader& header) {
  VolumeData& data = header.data;
  data.pieces = filesOf(path, text, bytes);
  if (data.bytes % data.pieces.size() != 0)
    throw Error(fmt::format("{} bytes do not spread evenly over {} files", data.bytes, data.pieces.size()));
  const bool binary = text.flag({"binarydata"}, true), compressed = text.flag({"compresseddata"}, false);
  data.encoding = compressed ? VolumeEncoding::kDeflated : (binary ? VolumeEncoding::kRaw : VolumeEncoding::kText);
  const std::string_view said = text.get({"headersize"});
  const auto skipped = said.empty() ? std::int64_t{0} : numberIn<std::int64_t>(said, "HeaderSize");
  if (skipped < -1) throw Error(fmt::format("HeaderSize is {}", skipped));
  for (VolumePiece& piece : data.pieces) {
    piece.atEnd = skipped == -1 && data.encoding == VolumeEncoding::kRaw;
    if (skipped > 0) piece.offset += static_cast<std::uint64_t>(skipped);
  }
}

}  // namespace

VolumeHeader readMetaImageHeader(const std::filesystem::path& path, const VolumeReadOptions& options) {
  const MappedFile file(path);
  const std::string_view bytes(file.bytes().data(), file.bytes().size());
  const MetaText text = readText(bytes);
  VolumeHeader header;
  header.volume.format = "MetaImage";
  header.volume.view.type = typeNamed(text.get({"elementtype"}));
  const std::vector<MemoryAxis> axes = axesOf(text);
  layOut(axes, options, header);
  place(text, static_cast<std::size_t>(numberIn<std::int64_t>(text.get({"ndims"}), "NDims")), header.volume);
  placeData(path, text, bytes, header);
  if (header.data.encoding != VolumeEncoding::kText)
    setByteOrder(text.flag({"binarydatabyteordermsb", "elementbyteordermsb"}, false), header);
  return header;
}

}  // namespace pdc::detail
