#include "io/parse/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "io/file/line_ends.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "io/parse/origin_text.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

PlyType typeNamed(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::kInt8;
  if (name == "uchar" || name == "uint8") return PlyType::kUint8;
  if (name == "short" || name == "int16") return PlyType::kInt16;
  if (name == "ushort" || name == "uint16") return PlyType::kUint16;
  if (name == "int" || name == "int32") return PlyType::kInt32;
  if (name == "uint" || name == "uint32") return PlyType::kUint32;
  if (name == "float" || name == "float32") return PlyType::kFloat32;
  if (name == "double" || name == "float64") return PlyType::kFloat64;
  return PlyType::kNone;
}

std::optional<PlyFormat> formatNamed(std::string_view name) {
  if (name == "ascii") return PlyFormat::kAscii;
  if (name == "binary_little_endian") return PlyFormat::kLittleEndian;
  if (name == "binary_big_endian") return PlyFormat::kBigEndian;
  return std::nullopt;
}

/// The names that readers look for are in lower case.
std::string propertyName(std::string_view name) {
  constexpr auto kCoordinates = std::to_array<std::string_view>({"x", "y", "z", "nx", "ny", "nz"});
  const std::string lower = lowerCase(name);
  const bool known = lower.starts_with("vertex_ind") ||
                     std::find(kCoordinates.begin(), kCoordinates.end(), lower) != kCoordinates.end();
  return known ? lower : std::string(name);
}

class Parser {
 public:
  explicit Parser(std::string_view bytes) : mScanner(bytes, '\0') {}

  PlyHeader parse() {
    if (!mScanner.nextLine() || lowerCase(mScanner.word()) != "ply") throw Error("not a PLY file");
    for (;;) {
      if (!mScanner.nextLine()) throw Error("a PLY header without end_header");
      const std::string keyword = lowerCase(mScanner.word());
      if (keyword == "end_header") break;
      readLine(keyword);
    }
    if (!mFormat) throw Error("a PLY header without format");
    mHeader.format = *mFormat;
    mHeader.body = mScanner.rest();
    mHeader.lines = mScanner.lineNumber();
    checkElements();
    return std::move(mHeader);
  }

 private:
  void readLine(const std::string& keyword) {
    if (keyword == "comment") {
      if (const auto origin = originInComment(mScanner.restOfLine())) takeOrigin(*origin, mHeader.origin);
      mHeader.isOwn |= mScanner.restOfLine() == kOwnComment;
    } else if (keyword == "format") {
      mFormat = formatNamed(lowerCase(mScanner.word()));
      if (!mFormat) throw malformed(mScanner, "format");
    } else if (keyword == "element") {
      readElement();
    } else if (keyword == "property") {
      readProperty();
    } else if (keyword != "obj_info") {
      throw malformed(mScanner, "PLY header");
    }
  }

  void readElement() {
    PlyElement element;
    element.name = lowerCase(mScanner.word());
    const auto count = mScanner.number<std::uint64_t>();
    if (element.name.empty() || !count) throw malformed(mScanner, "element");
    element.count = *count;
    mHeader.elements.push_back(std::move(element));
  }

  void readProperty() {
    if (mHeader.elements.empty()) throw malformed(mScanner, "property, which belongs to no element:");
    PlyProperty property;
    std::string type = lowerCase(mScanner.word());
    if (type == "list") {
      property.countType = typeNamed(lowerCase(mScanner.word()));
      if (property.countType == PlyType::kNone || plyIsReal(property.countType)) throw malformed(mScanner, "list");
      type = lowerCase(mScanner.word());
    }
    property.type = typeNamed(type);
    property.name = propertyName(mScanner.word());
    if (property.type == PlyType::kNone || property.name.empty()) throw malformed(mScanner, "property");
    mHeader.elements.back().properties.push_back(std::move(property));
  }

  /// Each value takes a byte at least, so what cannot be there is found before it is looked for.
  void checkElements() const {
    for (const PlyElement& element : mHeader.elements) {
      if (element.count == 0) continue;
      if (element.properties.empty()) throw Error(fmt::format("PLY element {} has no properties", element.name));
      if (element.count > mHeader.body.size() / element.properties.size())
        throw Error(fmt::format("{} elements of kind {} are announced, but only {} bytes follow the header",
                                element.count, element.name, mHeader.body.size()));
    }
  }

  TextScanner mScanner;
  std::optional<PlyFormat> mFormat;
  PlyHeader mHeader;
};

/// Where lines end with '\r' alone, the header must be parted from the body before they can change: the body may begin
/// with any byte.
void endHeaderLinesWithNewlines(std::span<char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  if (!beginsWithLoneReturn(text)) return;
  for (const std::string_view last : {"\rend_header\r", "\rEND_HEADER\r"})
    if (const std::size_t end = text.find(last); end != std::string_view::npos)
      return endLinesWithNewlines(bytes.first(end + last.size()));
}

}  // namespace

const char* plyTypeName(PlyType type) {
  constexpr std::array kNames{"", "char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

bool plyIsReal(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

bool isPly(std::string_view bytes) {
  constexpr std::string_view kMagic = "ply";
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || lowerCase(bytes.substr(begin, kMagic.size())) != kMagic) return false;
  const std::string_view after = bytes.substr(begin + kMagic.size());
  const std::size_t next = after.find_first_not_of(" \t");
  return next != std::string_view::npos && (after[next] == '\r' || after[next] == '\n');
}

PlyHeader parsePlyHeader(std::span<char> bytes) {
  endHeaderLinesWithNewlines(bytes);
  PlyHeader header = Parser({bytes.data(), bytes.size()}).parse();
  if (header.format == PlyFormat::kAscii) endLinesWithNewlines(bytes.last(header.body.size()));
  return header;
}

}  // namespace pdc::detail
