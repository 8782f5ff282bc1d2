#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pdc/math/vec3.h"

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
  std::optional<Vec3d> origin;  ///< What a comment says.
  bool isOwn = false;           ///< Whether a comment says that we wrote it.
  std::size_t lines = 0;        ///< How many lines the header has.
  std::string_view body;        ///< The bytes after the header.
};

/// Whether the first word is "ply" in either case, and a line of its own.
[[nodiscard]] bool isPly(std::string_view bytes);

/// Keywords may be in capitals, and so may the names of elements and of coordinates. \param bytes that outlive the
/// result; where lines end with '\r' alone, these become '\n'. \throws Error with the line's number
[[nodiscard]] PlyHeader parsePlyHeader(std::span<char> bytes);

}  // namespace pdc::detail
