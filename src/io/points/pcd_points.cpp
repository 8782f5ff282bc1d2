#include "io/points/pcd_points.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/suffix.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kMostFields = 1000, kMostCount = 1'000'000;

struct Field {
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
  std::size_t offset = 0;  ///< Bytes before it in a point.
};

struct Header {
  std::vector<Field> fields;
  std::size_t points = 0, bytes = 0;  ///< Bytes of a point.
  bool binary = false;
  std::string_view body;
  std::size_t lines = 0;
};

Header parseHeader(std::string_view bytes) {
  TextScanner scanner(bytes);
  Header header;
  std::optional<std::size_t> points, width, height;
  const auto whole = [&] {
    const auto value = scanner.number<std::size_t>();
    if (!value) throw malformed(scanner, "header");
    return *value;
  };
  while (scanner.nextLine()) {
    const std::string key = lowerCase(scanner.word());
    if (key == "fields" || key == "columns") {
      while (!scanner.restOfLine().empty()) header.fields.push_back({.name = lowerCase(scanner.word())});
    } else if (key == "size" || key == "count") {
      for (Field& field : header.fields) (key == "size" ? field.size : field.count) = whole();
    } else if (key == "type") {
      for (Field& field : header.fields) {
        const std::string_view word = scanner.word();
        if (word != "F" && word != "I" && word != "U") throw malformed(scanner, "header");
        field.type = word[0];
      }
    } else if (key == "width") {
      width = whole();
    } else if (key == "height") {
      height = whole();
    } else if (key == "points") {
      points = whole();
    } else if (key == "data") {
      const std::string kind = lowerCase(scanner.word());
      if (kind == "binary_compressed") throw Error("compressed .pcd files are not read, only ascii and binary ones");
      if (kind != "ascii" && kind != "binary") throw malformed(scanner, "header");
      header.binary = kind == "binary";
      header.body = scanner.rest();
      header.lines = scanner.lineNumber();
      break;
    } else if (key != "version" && key != "viewpoint") {
      throw malformed(scanner, "header");
    }
  }
  if (header.body.data() == nullptr) throw Error("has no DATA line, so it is no .pcd file or cut short");
  if (header.fields.size() > kMostFields)
    throw Error(fmt::format("{} fields; the limit is {}", header.fields.size(), kMostFields));
  for (Field& field : header.fields) {
    const bool known = field.type == 'F' ? field.size == 4 || field.size == 8
                                         : field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8;
    if (!known || field.count > kMostCount)
      throw Error(fmt::format("field \"{}\" has {} numbers of type {} and size {}", oneLine(field.name), field.count,
                              field.type, field.size));
    field.offset = header.bytes;
    header.bytes += field.size * field.count;
  }
  if (!points && (!width || !height)) throw Error("does not say how many points there are");
  if (!points && *height != 0 && *width > std::numeric_limits<std::size_t>::max() / *height)
    throw Error(fmt::format("{} by {} points are too many", *width, *height));
  header.points = points ? *points : *width * *height;
  return header;
}

template <typename Number>
double take(const char* at) {
  Number number;
  std::memcpy(&number, at, sizeof(number));
  return static_cast<double>(number);
}

double numberAt(const Field& field, const char* at) {
  static_assert(std::endian::native == std::endian::little);
  if (field.type == 'F') return field.size == 4 ? take<float>(at) : take<double>(at);
  const bool isSigned = field.type == 'I';
  switch (field.size) {
    case 1:
      return isSigned ? take<std::int8_t>(at) : take<std::uint8_t>(at);
    case 2:
      return isSigned ? take<std::int16_t>(at) : take<std::uint16_t>(at);
    case 4:
      return isSigned ? take<std::int32_t>(at) : take<std::uint32_t>(at);
    default:
      return isSigned ? take<std::int64_t>(at) : take<std::uint64_t>(at);
  }
}

/// Takes the numbers of points one after the other, and keeps those that a cloud has a place for.
class Collector {
 public:
  explicit Collector(const Header& header) : mHeader(header) {
    const auto find = [&](std::string_view name) {
      for (const Field& field : header.fields)
        if (field.name == name && field.count == 1) return &field;
      return static_cast<const Field*>(nullptr);
    };
    constexpr std::array kAxes{"x", "y", "z"}, kNormals{"normal_x", "normal_y", "normal_z"};
    for (std::size_t k = 0; k < 3; ++k) {
      mPosition[k] = find(kAxes[k]);
      mNormal[k] = find(kNormals[k]);
      if (mPosition[k] == nullptr) throw Error(fmt::format("has no field \"{}\"", kAxes[k]));
    }
    mHasNormal = mNormal[0] != nullptr && mNormal[1] != nullptr && mNormal[2] != nullptr;
    mSigma = find("sigma");
    mColour = find("rgb") != nullptr ? find("rgb") : find("rgba");
    if (mColour != nullptr && mColour->size != 4) mColour = nullptr;
  }

  /// \param valueOf gives the number of a field, \param bitsOf the bits of a packed colour.
  template <typename Value, typename Bits>
  void add(PointCloud& cloud, const Value& valueOf, const Bits& bitsOf) const {
    const auto vector = [&](const auto& fields) {
      return Vec3d{valueOf(*fields[0]), valueOf(*fields[1]), valueOf(*fields[2])};
    };
    cloud.positions.push_back(vector(mPosition));
    if (mHasNormal) cloud.normals.push_back(vecCast<float>(vector(mNormal)));
    if (mSigma != nullptr) cloud.sigmas.push_back(static_cast<float>(valueOf(*mSigma)));
    if (mColour == nullptr) return;
    const std::uint32_t bits = bitsOf(*mColour);
    const auto byte = [bits](int shift) { return static_cast<std::uint8_t>(bits >> shift & 0xff); };
    cloud.colours.push_back({byte(16), byte(8), byte(0)});
  }

 private:
  const Header& mHeader;
  std::array<const Field*, 3> mPosition{}, mNormal{};
  const Field *mSigma = nullptr, *mColour = nullptr;
  bool mHasNormal = false;
};

PointCloud readBinary(const Header& header) {
  if (header.bytes == 0 || header.body.size() / header.bytes < header.points)
    throw Error(fmt::format("ends before the last of {} points of {} bytes", header.points, header.bytes));
  const Collector collector(header);
  PointCloud cloud;
  for (std::size_t i = 0; i < header.points; ++i) {
    const char* const at = header.body.data() + i * header.bytes;
    const auto bits = [at](const Field& field) {
      std::uint32_t packed = 0;
      std::memcpy(&packed, at + field.offset, sizeof(packed));
      return packed;
    };
    collector.add(
        cloud, [at](const Field& field) { return numberAt(field, at + field.offset); }, bits);
  }
  return cloud;
}

PointCloud readAscii(const Header& header) {
  const Collector collector(header);
  TextScanner scanner(header.body, '\0');
  PointCloud cloud;
  std::vector<double> numbers(header.fields.size());
  for (std::size_t i = 0; i < header.points; ++i) {
    if (!scanner.nextLine()) throw Error(fmt::format("ends after {} of {} points", i, header.points));
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
      for (std::size_t k = 0; k < header.fields[f].count; ++k) {
        const auto number = TextScanner::parse<double>(scanner.word());
        if (!number)
          throw Error(fmt::format("line {}: field \"{}\" is not a number", header.lines + scanner.lineNumber(),
                                  oneLine(header.fields[f].name)));
        numbers[f] = *number;
      }
    }
    const auto valueOf = [&](const Field& field) {
      return numbers[static_cast<std::size_t>(&field - header.fields.data())];
    };
    const auto bits = [&](const Field& field) {
      return field.type == 'F' ? std::bit_cast<std::uint32_t>(static_cast<float>(valueOf(field)))
                               : static_cast<std::uint32_t>(valueOf(field));
    };
    collector.add(cloud, valueOf, bits);
  }
  return cloud;
}

}  // namespace

PointCloud readPcdPoints(std::string_view bytes) {
  const Header header = parseHeader(bytes);
  return header.binary ? readBinary(header) : readAscii(header);
}

}  // namespace pdc::detail
