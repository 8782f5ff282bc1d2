#include "io/mesh/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "io/file/text_scanner.h"
#include "io/mesh/ply_columns.h"
#include "io/mesh/ply_header.h"
#include "io/mesh/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// Reads the numbers of the body one after the other, as double: it holds all of PLY's types.
class BinaryNumbers {
 public:
  BinaryNumbers(std::string_view body, bool swap) : mBody(body), mSwap(swap) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      case PlyType::kUint32:
        return take<std::uint32_t>();
      case PlyType::kFloat32:
        return take<float>();
      case PlyType::kFloat64:
        return take<double>();
      case PlyType::kNone:
        break;
    }
    return 0;
  }

 private:
  template <typename Number>
  Number take() {
    if (mBody.size() < sizeof(Number)) throw Error("ends before the last of the elements announced in its header");
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), mBody.data(), sizeof(Number));
    mBody.remove_prefix(sizeof(Number));
    if (mSwap) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::string_view mBody;
  bool mSwap;
};

class TextNumbers {
 public:
  explicit TextNumbers(std::string_view body) : mScanner(body, '\0') {}

  double next(PlyType type) {
    std::string_view word = mScanner.word();
    while (word.empty()) {
      if (!mScanner.nextLine()) throw Error("ends before the last of the elements announced in its header");
      word = mScanner.word();
    }
    // Read as what it is: from decimal to double to float would round twice.
    const auto value =
        type == PlyType::kFloat32 ? widen(TextScanner::parse<float>(word)) : TextScanner::parse<double>(word);
    if (!value)
      throw Error(fmt::format("line {} after the header: \"{}\" is not a number", mScanner.lineNumber(), word));
    return *value;
  }

 private:
  static std::optional<double> widen(std::optional<float> value) {
    return value ? std::optional<double>(*value) : std::nullopt;
  }

  TextScanner mScanner;
};

template <typename Numbers>
class BodyReader {
 public:
  explicit BodyReader(Numbers numbers) : mNumbers(numbers) {}

  Mesh read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face") {
        readFaces(element);
      } else {
        for (std::size_t i = 0; i < element.count; ++i)
          for (const PlyProperty& property : element.properties) skip(property);
      }
    }
    return mSoup.finish();
  }

 private:
  void skip(const PlyProperty& property) {
    const double count = property.isList() ? mNumbers.next(property.countType) : 1;
    for (double i = 0; i < count; ++i) mNumbers.next(property.type);
  }

  void readVertices(const PlyElement& element) {
    if (std::exchange(mHasVertices, true)) throw Error("a PLY file with two elements named vertex");
    constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
    constexpr std::size_t kOther = kNames.size();
    std::vector<std::size_t> places;
    for (const PlyProperty& p : element.properties) {
      const auto place = static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), p.name) - kNames.begin());
      places.push_back(p.isList() ? kOther : place);
    }
    const auto hasAll = [&](std::size_t first) {
      for (std::size_t i = first; i < first + 3; ++i)
        if (std::count(places.begin(), places.end(), i) != 1) return false;
      return true;
    };
    if (!hasAll(0)) throw Error("PLY vertices need x, y and z, each once");
    const bool normals = hasAll(3);

    PlyColumns columns = plyColumns(element.properties);
    std::array<double, kNames.size()> v{};
    for (std::size_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < places.size(); ++k) {
        if (places[k] != kOther) {
          v[places[k]] = mNumbers.next(element.properties[k].type);
        } else if (columns.propertyOf[k] != PlyColumns::kNoProperty) {
          keep(mNumbers.next(element.properties[k].type), columns.properties[columns.propertyOf[k]], i);
        } else {
          skip(element.properties[k]);
        }
      }
      mSoup.addVertex(vecCast<float>(Vec3d{v[0], v[1], v[2]}));
      if (normals) mSoup.addNormal(vecCast<float>(Vec3d{v[3], v[4], v[5]}));
    }
    mSoup.setProperties(std::move(columns.properties));
  }

  /// Appends a number of vertex i.
  static void keep(double number, VertexProperty& property, std::size_t i) {
    std::visit(
        [&]<typename Number>(Buffer<Number>& values) {
          if constexpr (std::is_integral_v<Number>) {
            using Limits = std::numeric_limits<Number>;
            if (!(number >= Limits::min() && number <= Limits::max() && number == std::floor(number)))
              throw Error(fmt::format("vertex {}: \"{}\" is {}, which is no {}", i, property.name, number,
                                      plyTypeName(plyType(property))));
          }
          values.push_back(static_cast<Number>(number));
        },
        property.values);
  }

  void readFaces(const PlyElement& element) {
    const auto isIndices = [](const PlyProperty& p) {
      return p.isList() && !plyIsReal(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    const auto indices = std::find_if(element.properties.begin(), element.properties.end(), isIndices);
    if (indices == element.properties.end()) throw Error("PLY faces need a list vertex_indices of integers");
    std::vector<std::int64_t> corners;
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property != &*indices) {
          skip(property);
          continue;
        }
        corners.clear();
        const double count = mNumbers.next(property.countType);
        for (double k = 0; k < count; ++k) corners.push_back(toIndex(mNumbers.next(property.type)));
        mSoup.addFace(corners);
      }
    }
  }

  /// -1, which no mesh has, for what is not an index.
  static std::int64_t toIndex(double number) {
    constexpr double kLimit = 4294967296.0;
    return number >= 0 && number < kLimit && number == std::floor(number) ? static_cast<std::int64_t>(number) : -1;
  }

  Numbers mNumbers;
  SoupBuilder mSoup;
  bool mHasVertices = false;
};

}  // namespace

Mesh readPly(std::string_view bytes) {
  const PlyHeader header = parsePlyHeader(bytes);
  if (header.format == PlyFormat::kAscii) return BodyReader(TextNumbers(header.body)).read(header);
  const bool little = header.format == PlyFormat::kLittleEndian;
  const bool swap = little != (std::endian::native == std::endian::little);
  return BodyReader(BinaryNumbers(header.body, swap)).read(header);
}

}  // namespace pdc::detail
