#include "io/mesh/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "io/file/text_scanner.h"
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

class Parser {
 public:
  explicit Parser(std::string_view bytes) : mScanner(bytes, '\0') {}

  PlyHeader parse() {
    if (!mScanner.nextLine() || !isMagic(mScanner.word())) throw Error("not a PLY file");
    std::optional<PlyFormat> format;
    for (;;) {
      if (!mScanner.nextLine()) throw Error("a PLY header without end_header");
      const std::string_view keyword = mScanner.word();
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "format") {
        format = formatNamed(mScanner.word());
        if (!format) throw malformed("format");
      } else if (keyword == "element") {
        readElement();
      } else if (keyword == "property") {
        readProperty();
      } else {
        throw malformed("PLY header");
      }
    }
    if (!format) throw Error("a PLY header without format");
    mHeader.format = *format;
    mHeader.body = mScanner.rest();
    checkElements();
    return std::move(mHeader);
  }

 private:
  static bool isMagic(std::string_view word) { return word == "ply" || word == "PLY"; }

  Error malformed(std::string_view what) const {
    return Error(fmt::format("line {}: malformed {}", mScanner.lineNumber(), what));
  }

  void readElement() {
    PlyElement element;
    element.name = mScanner.word();
    const auto count = mScanner.number<std::uint64_t>();
    if (element.name.empty() || !count) throw malformed("element");
    element.count = *count;
    mHeader.elements.push_back(std::move(element));
  }

  void readProperty() {
    if (mHeader.elements.empty()) throw malformed("property: it belongs to no element");
    PlyProperty property;
    std::string_view type = mScanner.word();
    if (type == "list") {
      property.countType = typeNamed(mScanner.word());
      if (property.countType == PlyType::kNone || plyIsReal(property.countType)) throw malformed("list");
      type = mScanner.word();
    }
    property.type = typeNamed(type);
    property.name = mScanner.word();
    if (property.type == PlyType::kNone || property.name.empty()) throw malformed("property");
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
  PlyHeader mHeader;
};

}  // namespace

const char* plyTypeName(PlyType type) {
  constexpr std::array kNames{"", "char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

bool plyIsReal(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

PlyHeader parsePlyHeader(std::string_view bytes) { return Parser(bytes).parse(); }

}  // namespace pdc::detail
