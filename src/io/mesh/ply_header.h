#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pdc::detail {

enum class PlyType { kNone, kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// What headers call it: "char", "uchar", "short", "ushort", "int", "uint", "float", "double"; "" for kNone.
[[nodiscard]] const char* plyTypeName(PlyType type);
[[nodiscard]] bool plyIsReal(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kNone;
  PlyType countType = PlyType::kNone;  ///< The type of a list's length; kNone for a single value.

  [[nodiscard]] bool isList() const { return countType != PlyType::kNone; }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;  ///< Not empty if count > 0.
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format{};
  std::vector<PlyElement> elements;
  std::string_view body;  ///< The bytes after the header.
};

/// `bytes` must outlive the result. \throws Error with the line's number
[[nodiscard]] PlyHeader parsePlyHeader(std::string_view bytes);

}  // namespace pdc::detail
