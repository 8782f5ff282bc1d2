#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostDimensions = 16;

/// The header's fields, and what follows it.
struct NrrdText {
  std::map<std::string, std::string, std::less<>> fields;
  std::vector<std::string> files;  ///< The lines after "data file: LIST".
  std::size_t end = 0;             ///< Where the header ends.

  [[nodiscard]] std::string_view get(std::string_view name) const {
    const auto found = fields.find(name);
    return found == fields.end() ? std::string_view{} : std::string_view(found->second);
  }
  [[nodiscard]] std::string_view need(std::string_view name) const {
    const std::string_view value = get(name);
    if (value.empty()) throw Error(fmt::format("the header does not say \"{}\"", name));
    return value;
  }
};

/// Names without blanks, so that "line skip" and "lineskip" are one.
std::string fieldName(std::string_view text) {
  std::string name = lowerCase(trimmed(text));
  std::erase(name, ' ');
  return name == "centerings" ? "centers" : name;
}

NrrdText readText(std::string_view bytes) {
  if (!bytes.starts_with("NRRD")) throw Error("not NRRD: it does not begin with NRRD000");
  NrrdText text;
  bool first = true, list = false;
  while (text.end < bytes.size()) {
    const std::size_t newline = std::min(bytes.find('\n', text.end), bytes.size());
    const std::string_view line = trimmed(bytes.substr(text.end, newline - text.end));
    text.end = std::min(newline + 1, bytes.size());
    if (first) {
      first = false;
      continue;
    }
    if (line.empty()) break;
    if (line.starts_with('#')) continue;
    if (list) {
      text.files.emplace_back(line);
      continue;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos)
      throw Error(fmt::format("\"{}\" is no line of a NRRD header", oneLine(line.substr(0, 60))));
    if (line.substr(colon).starts_with(":=")) continue;  // a key and value of somebody's own
    const std::string name = fieldName(line.substr(0, colon));
    const std::string_view value = trimmed(line.substr(colon + 1));
    text.fields[name] = value;
    list = name == "datafile" && value.starts_with("LIST");
  }
  return text;
}

ScalarType typeNamed(std::string_view name) {
  static const std::map<std::string_view, ScalarType> kTypes{{"signed char", ScalarType::kInt8},
                                                             {"int8", ScalarType::kInt8},
                                                             {"int8_t", ScalarType::kInt8},
                                                             {"uchar", ScalarType::kUint8},
                                                             {"unsigned char", ScalarType::kUint8},
                                                             {"uint8", ScalarType::kUint8},
                                                             {"uint8_t", ScalarType::kUint8},
                                                             {"short", ScalarType::kInt16},
                                                             {"short int", ScalarType::kInt16},
                                                             {"signed short", ScalarType::kInt16},
                                                             {"signed short int", ScalarType::kInt16},
                                                             {"int16", ScalarType::kInt16},
                                                             {"int16_t", ScalarType::kInt16},
                                                             {"ushort", ScalarType::kUint16},
                                                             {"unsigned short", ScalarType::kUint16},
                                                             {"unsigned short int", ScalarType::kUint16},
                                                             {"uint16", ScalarType::kUint16},
                                                             {"uint16_t", ScalarType::kUint16},
                                                             {"int", ScalarType::kInt32},
                                                             {"signed int", ScalarType::kInt32},
                                                             {"int32", ScalarType::kInt32},
                                                             {"int32_t", ScalarType::kInt32},
                                                             {"uint", ScalarType::kUint32},
                                                             {"unsigned int", ScalarType::kUint32},
                                                             {"uint32", ScalarType::kUint32},
                                                             {"uint32_t", ScalarType::kUint32},
                                                             {"longlong", ScalarType::kInt64},
                                                             {"long long", ScalarType::kInt64},
                                                             {"long long int", ScalarType::kInt64},
                                                             {"signed long long", ScalarType::kInt64},
                                                             {"int64", ScalarType::kInt64},
                                                             {"int64_t", ScalarType::kInt64},
                                                             {"ulonglong", ScalarType::kUint64},
                                                             {"unsigned long long", ScalarType::kUint64},
                                                             {"unsigned long long int", ScalarType::kUint64},
                                                             {"uint64", ScalarType::kUint64},
                                                             {"uint64_t", ScalarType::kUint64},
                                                             {"float", ScalarType::kFloat32},
                                                             {"double", ScalarType::kFloat64}};
  const auto found = kTypes.find(lowerCase(name));
  if (found == kTypes.end()) throw Error(fmt::format("NRRD values of type \"{}\" are not read", oneLine(name)));
  return found->second;
}

/// What one axis says. Numbers that are not said are NaN.
struct NrrdAxis {
  std::int64_t size = 0;
  std::optional<Vec3d> direction{};
  bool none = false;  ///< It has no direction in space.
  double spacing = kUnknown, min = kUnknown, max = kUnknown;
  bool cell = false;  ///< Its samples are centres of cells; else lattice points.
  std::string kind;
};

double realOrUnknown(std::string_view word, std::string_view field) {
  const std::string lower = lowerCase(word);
  return lower == "nan" || lower == "?" ? kUnknown : numberIn<double>(word, field);
}

/// A vector like (1,0,0).
Vec3d vectorIn(std::string_view text, std::string_view field) {
  std::string inner(trimmed(text));
  if (inner.size() < 2 || inner.front() != '(' || inner.back() != ')')
    throw Error(fmt::format("{}: \"{}\" is no vector like (1,0,0)", field, oneLine(text.substr(0, 60))));
  inner = inner.substr(1, inner.size() - 2);
  std::replace(inner.begin(), inner.end(), ',', ' ');
  const std::vector<double> v = numbersIn<double>(inner, field, 3);
  return {v[0], v[1], v[2]};
}

/// Vectors and "none", with blanks between them and, as some write, in them.
std::vector<std::string> vectorWords(std::string_view text) {
  std::vector<std::string> words;
  int depth = 0;
  bool inWord = false;
  for (const char c : text) {
    if (depth == 0 && (c == ' ' || c == '\t')) {
      inWord = false;
      continue;
    }
    if (!inWord || (depth == 0 && c == '(')) words.emplace_back();
    inWord = true;
    depth += c == '(' ? 1 : (c == ')' ? -1 : 0);
    words.back() += c;
    if (c == ')') inWord = false;
  }
  return words;
}

/// Words that may stand in quotation marks.
std::vector<std::string> quotedWords(std::string_view text) {
  std::vector<std::string> words;
  for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
    const bool quoted = rest.front() == '"';
    if (quoted) rest.remove_prefix(1);
    const std::size_t end = std::min(quoted ? rest.find('"') : rest.find_first_of(" \t"), rest.size());
    words.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

std::vector<NrrdAxis> readAxes(const NrrdText& text) {
  const auto dimensions = numberIn<std::int64_t>(text.need("dimension"), "dimension");
  if (dimensions < 3 || dimensions > static_cast<std::int64_t>(kMostDimensions))
    throw Error(fmt::format("has {} dimensions; a volume has 3", dimensions));
  const auto count = static_cast<std::size_t>(dimensions);
  std::vector<NrrdAxis> axes(count);
  const auto sizes = numbersIn<std::int64_t>(text.need("sizes"), "sizes", count);
  for (std::size_t i = 0; i < count; ++i) axes[i].size = sizes[i];
  const auto each = [&](const char* field, const auto& take) {
    const std::vector<std::string_view> words = wordsOf(text.get(field));
    if (words.empty()) return;
    if (words.size() != count)
      throw Error(fmt::format("{}: {} values are there, {} are needed", field, words.size(), count));
    for (std::size_t i = 0; i < count; ++i) take(axes[i], words[i]);
  };
  each("spacings", [](NrrdAxis& a, std::string_view w) { a.spacing = realOrUnknown(w, "spacings"); });
  each("axismins", [](NrrdAxis& a, std::string_view w) { a.min = realOrUnknown(w, "axis mins"); });
  each("axismaxs", [](NrrdAxis& a, std::string_view w) { a.max = realOrUnknown(w, "axis maxs"); });
  each("centers", [](NrrdAxis& a, std::string_view w) { a.cell = lowerCase(w) == "cell"; });
  each("kinds", [](NrrdAxis& a, std::string_view w) { a.kind = lowerCase(w); });
  const std::vector<std::string> directions = vectorWords(text.get("spacedirections"));
  if (!directions.empty() && directions.size() != count)
    throw Error(fmt::format("space directions: {} are there, {} are needed", directions.size(), count));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    axes[i].none = lowerCase(directions[i]) == "none";
    if (!axes[i].none) axes[i].direction = vectorIn(directions[i], "space directions");
  }
  return axes;
}

/// Whether the axis runs through the values of a point rather than through space.
bool isChannel(const NrrdAxis& axis) {
  return axis.none || !(axis.kind.empty() || axis.kind == "domain" || axis.kind == "space" || axis.kind == "time" ||
                        axis.kind == "???" || axis.kind == "none");
}

/// Says which axes are x, y and z: those of space, in their order, and the last of the others where all look alike.
std::vector<MemoryAxis> rolesOf(const std::vector<NrrdAxis>& axes) {
  std::vector<MemoryAxis> roles;
  int spatial = 0;
  for (const NrrdAxis& axis : axes) {
    if (isChannel(axis))
      roles.push_back({axis.size, MemoryAxis::kChannel});
    else
      roles.push_back({axis.size, spatial++ < 3 ? spatial - 1 : MemoryAxis::kVolume});
  }
  if (spatial < 3) throw Error(fmt::format("{} of its axes are of space; 3 are needed", spatial));
  const auto several = [&](int role) {
    return std::count_if(roles.begin(), roles.end(), [&](const MemoryAxis& a) { return a.role == role; }) > 1;
  };
  if (several(MemoryAxis::kChannel) || several(MemoryAxis::kVolume))
    throw Error(fmt::format("has {} dimensions, of which more than one are not of space", axes.size()));
  return roles;
}

std::string spaceNamed(std::string_view name) {
  std::string lower = lowerCase(name);
  if (lower.ends_with("-time")) lower.resize(lower.size() - 5);
  if (lower == "right-anterior-superior" || lower == "ras" || lower == "rast") return "RAS";
  if (lower == "left-anterior-superior" || lower == "las" || lower == "last") return "LAS";
  if (lower == "left-posterior-superior" || lower == "lps" || lower == "lpst") return "LPS";
  return oneLine(name);
}

/// Where the first sample is along an axis without a direction, and how far the next.
std::pair<double, double> startAndStep(const NrrdAxis& axis) {
  double step = axis.spacing;
  if (std::isnan(step) && !std::isnan(axis.min) && !std::isnan(axis.max))
    step =
        (axis.max - axis.min) / static_cast<double>(axis.cell ? axis.size : std::max<std::int64_t>(axis.size - 1, 1));
  double start = std::isnan(axis.min) ? 0 : axis.min;
  if (axis.cell && !std::isnan(axis.min) && !std::isnan(step)) start += step / 2;
  return {start, step};
}

void placeByAxes(const std::array<const NrrdAxis*, 3>& axes, DenseVolume& volume) {
  Vec3d steps;
  for (int i = 0; i < 3; ++i) {
    const auto [start, step] = startAndStep(*axes[static_cast<std::size_t>(i)]);
    steps[i] = step;
    volume.translation[i] = start;
  }
  if (std::isnan(steps.x) && std::isnan(steps.y) && std::isnan(steps.z)) return noteNoSpacing(volume);
  steps = regularSpacing(steps, "spacings", volume);
  volume.linear = Mat3d::diagonal(steps.x, steps.y, steps.z);
  volume.orientation = "spacings";
}

void place(const NrrdText& text, const std::array<const NrrdAxis*, 3>& axes, DenseVolume& volume) {
  if (const std::string_view space = text.get("space"); !space.empty()) volume.space = spaceNamed(space);
  const std::vector<std::string> units = quotedWords(text.get(text.get("spaceunits").empty() ? "units" : "spaceunits"));
  std::vector<std::string> named;
  for (const std::string& unit : units)
    if (!unit.empty() && unit != "???" && unit != "none") named.push_back(oneLine(unit));
  if (!named.empty() && std::equal(named.begin() + 1, named.end(), named.begin()))
    volume.unit = named.front();
  else if (!named.empty())
    volume.warnings.push_back("its axes have different units; they were left as they are");
  if (!axes[0]->direction) return placeByAxes(axes, volume);
  for (int i = 0; i < 3; ++i)
    for (int row = 0; row < 3; ++row)
      volume.linear.row[static_cast<std::size_t>(row)][i] = (*axes[static_cast<std::size_t>(i)]->direction)[row];
  if (const std::string_view origin = text.get("spaceorigin"); !origin.empty())
    volume.translation = vectorIn(origin, "space origin");
  volume.orientation = "space directions";
}

VolumeEncoding encodingNamed(std::string_view name) {
  const std::string lower = lowerCase(name);
  if (lower == "raw") return VolumeEncoding::kRaw;
  if (lower == "gzip" || lower == "gz") return VolumeEncoding::kDeflated;
  if (lower == "ascii" || lower == "text" || lower == "txt") return VolumeEncoding::kText;
  throw Error(fmt::format("NRRD encoding \"{}\" is not read: raw, gzip and ascii are", oneLine(name)));
}

/// The files of "data file: NAME", "data file: LIST" or "data file: PATTERN MIN MAX STEP".
std::vector<VolumePiece> detachedFiles(const std::filesystem::path& header, const NrrdText& text) {
  const std::string_view said = text.get("datafile");
  std::vector<VolumePiece> pieces;
  const std::vector<std::string_view> words = wordsOf(said);
  if (said.starts_with("LIST")) {
    for (const std::string& name : text.files) pieces.push_back({besideHeader(header, name)});
  } else if (words.size() >= 4 && words[0].find('%') != std::string_view::npos) {
    const auto begin = numberIn<std::int32_t>(words[1], "data file"),
               end = numberIn<std::int32_t>(words[2], "data file"),
               step = numberIn<std::int32_t>(words[3], "data file");
    constexpr std::int64_t kMostFiles = 1 << 20;
    if (step == 0 || (std::int64_t{end} - begin) / step < 0 || (std::int64_t{end} - begin) / step >= kMostFiles)
      throw Error(fmt::format("data file: {} to {} in steps of {} are no numbers of files", begin, end, step));
    for (std::int64_t n = begin; step > 0 ? n <= end : n >= end; n += step)
      pieces.push_back({patternFile(header, words[0], n)});
  } else {
    pieces.push_back({besideHeader(header, said)});
  }
  if (pieces.empty()) throw Error("the header names no data files");
  return pieces;
}

/// Where the bytes are `lines` lines on. \throws Error if there are fewer.
std::uint64_t skipLines(std::string_view bytes, std::uint64_t begin, std::int64_t lines) {
  for (std::int64_t i = 0; i < lines; ++i) {
    const std::size_t newline = bytes.find('\n', begin);
    if (newline == std::string_view::npos) throw Error(fmt::format("line skip: there are no {} lines", lines));
    begin = newline + 1;
  }
  return begin;
}

void placeData(const std::filesystem::path& path, const NrrdText& text, std::string_view bytes, VolumeHeader& header) {
  VolumeData& data = header.data;
  data.encoding = encodingNamed(text.need("encoding"));
  const bool attached = text.get("datafile").empty();
  data.pieces = attached ? std::vector<VolumePiece>{{path, text.end}} : detachedFiles(path, text);
  if (data.bytes % data.pieces.size() != 0)
    throw Error(fmt::format("{} bytes do not spread evenly over {} files", data.bytes, data.pieces.size()));
  const auto skip = [&](const char* name) {
    return text.get(name).empty() ? std::int64_t{0} : numberIn<std::int64_t>(text.get(name), name);
  };
  const std::int64_t lines = skip("lineskip"), skipped = skip("byteskip");
  if (lines < 0 || skipped < -1) throw Error("line skip and byte skip must not be negative, but for a byte skip of -1");
  for (VolumePiece& piece : data.pieces) {
    if (lines > 0 && attached) piece.offset = skipLines(bytes, piece.offset, lines);
    if (lines > 0 && !attached) {
      const MappedFile file(piece.path);
      piece.offset = skipLines({file.bytes().data(), file.bytes().size()}, piece.offset, lines);
    }
    if (skipped == -1 && data.encoding != VolumeEncoding::kRaw)
      throw Error("a byte skip of -1 goes with raw values only");
    piece.atEnd = skipped == -1;
  }
  if (skipped > 0 && data.encoding == VolumeEncoding::kText)
    for (VolumePiece& piece : data.pieces) piece.offset += static_cast<std::uint64_t>(skipped);
  else if (skipped > 0)
    data.skip = static_cast<std::uint64_t>(skipped);
}

}  // namespace

VolumeHeader readNrrdHeader(const std::filesystem::path& path, const VolumeReadOptions& options) {
  const MappedFile file(path);
  const std::string_view bytes(file.bytes().data(), file.bytes().size());
  const NrrdText text = readText(bytes);
  VolumeHeader header;
  DenseVolume& volume = header.volume;
  volume.format = "NRRD";
  volume.view.type = typeNamed(text.need("type"));
  const std::vector<NrrdAxis> axes = readAxes(text);
  const std::vector<MemoryAxis> roles = rolesOf(axes);
  layOut(roles, options, header);
  std::array<const NrrdAxis*, 3> spatial{};
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (roles[i].role < MemoryAxis::kChannel) spatial[static_cast<std::size_t>(roles[i].role)] = &axes[i];
  place(text, spatial, volume);
  placeData(path, text, bytes, header);
  if (header.data.encoding != VolumeEncoding::kText && sizeOf(volume.view.type) > 1) {
    const std::string endian = lowerCase(text.need("endian"));
    if (endian != "little" && endian != "big")
      throw Error(fmt::format("endian: \"{}\" is neither little nor big", oneLine(endian)));
    setByteOrder(endian == "big", header);
  }
  return header;
}

}  // namespace pdc::detail
