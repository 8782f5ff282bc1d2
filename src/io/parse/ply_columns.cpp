#include "io/parse/ply_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <string_view>

namespace pdc::detail {
namespace {

constexpr std::array<std::string_view, 4> kSuffixes{"_x", "_y", "_z", "_w"};

bool isReserved(std::string_view name) {
  return name == "x" || name == "y" || name == "z" || name == "nx" || name == "ny" || name == "nz";
}

PropertyValues emptyValues(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return Buffer<std::int8_t>();
    case PlyType::kUint8:
      return Buffer<std::uint8_t>();
    case PlyType::kInt16:
      return Buffer<std::int16_t>();
    case PlyType::kUint16:
      return Buffer<std::uint16_t>();
    case PlyType::kInt32:
      return Buffer<std::int32_t>();
    case PlyType::kUint32:
      return Buffer<std::uint32_t>();
    case PlyType::kFloat64:
      return Buffer<double>();
    case PlyType::kFloat32:
    case PlyType::kNone:
      break;
  }
  return Buffer<float>();
}

/// Looks for properties among columns.
class Grouping {
 public:
  explicit Grouping(const std::vector<PlyProperty>& columns) : mColumns(columns) {
    std::set<std::string_view> names;
    for (const PlyProperty& column : columns) {
      const bool isNew = names.insert(column.name).second;
      mUsable.push_back(isNew && !column.isList() && !isReserved(column.name));
    }
  }

  PlyColumns run() const {
    PlyColumns result;
    for (std::size_t k = 0; k < mColumns.size();) {
      const std::size_t size = mUsable[k] ? sizeOfVector(k) : 1;
      if (mUsable[k]) {
        const std::string& name = mColumns[k].name;
        result.properties.push_back(
            {size > 1 ? name.substr(0, name.size() - 2) : name, static_cast<int>(size), emptyValues(mColumns[k].type)});
      }
      result.propertyOf.insert(result.propertyOf.end(), size,
                               mUsable[k] ? result.properties.size() - 1 : PlyColumns::kNoProperty);
      k += size;
    }
    return result;
  }

 private:
  /// How many columns from `first` on make a vector; 1 if none begins there.
  [[nodiscard]] std::size_t sizeOfVector(std::size_t first) const {
    const std::string_view name = mColumns[first].name;
    if (name.size() < 3 || !name.ends_with(kSuffixes[0])) return 1;
    const std::string base(name.substr(0, name.size() - 2));
    if (std::any_of(mColumns.begin(), mColumns.end(), [&](const auto& c) { return c.name == base; })) return 1;
    std::size_t size = 1;
    while (size < kSuffixes.size() && first + size < mColumns.size() && mUsable[first + size] &&
           mColumns[first + size].type == mColumns[first].type &&
           mColumns[first + size].name == base + std::string(kSuffixes[size]))
      ++size;
    return size;
  }

  const std::vector<PlyProperty>& mColumns;
  std::vector<bool> mUsable;
};

}  // namespace

std::vector<std::string> plyColumnNames(const VertexProperty& property) {
  if (property.components == 1) return {property.name};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < static_cast<std::size_t>(property.components); ++k)
    names.push_back(property.name + std::string(kSuffixes[k]));
  return names;
}

PlyType plyType(const VertexProperty& property) {
  constexpr std::array kTypes{PlyType::kInt8,  PlyType::kUint8,  PlyType::kInt16,   PlyType::kUint16,
                              PlyType::kInt32, PlyType::kUint32, PlyType::kFloat32, PlyType::kFloat64};
  static_assert(kTypes.size() == std::variant_size_v<PropertyValues>);
  return kTypes[property.values.index()];
}

PlyColumns plyColumns(const std::vector<PlyProperty>& columns) { return Grouping(columns).run(); }

void checkPlyNames(const Mesh& mesh) {
  std::set<std::string> names;
  for (const VertexProperty& property : mesh.properties)
    for (const std::string& name : plyColumnNames(property)) {
      const bool blank = std::any_of(name.begin(), name.end(),
                                     [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '\x7f'; });
      if (property.name.empty() || blank || isReserved(name) || !names.insert(name).second)
        throw std::invalid_argument(fmt::format("writeMesh: a .ply file cannot hold a property \"{}\"{}", name,
                                                blank ? "" : " here: the name is taken"));
    }
}

}  // namespace pdc::detail
