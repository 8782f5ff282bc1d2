#include "io/parse/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "io/parse/ply_columns.h"
#include "io/parse/ply_header.h"
#include "io/parse/ply_numbers.h"
#include "io/parse/soup_builder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

template <typename Numbers>
class BodyReader {
 public:
  BodyReader(Numbers numbers, const Vec3d& shift) : mNumbers(numbers), mSoup(shift) {}

  ParsedMesh read(const PlyHeader& header) {
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face") {
        readLists(element, [&] { mSoup.addFace(mCorners, mNumbers.line()); });
      } else if (element.name == "tristrips") {
        readLists(element, [&] { addStrip(); });
      } else {
        skipElement(element);
      }
    }
    if (const std::size_t left = mNumbers.left(); left > 0)
      mSoup.warn(fmt::format("{} bytes after the last element are not read", left));
    mSoup.splitQuads(header.isOwn);
    return mSoup.finish(header.origin);
  }

 private:
  static bool isIndices(const PlyProperty& p) { return p.isList() && p.name.starts_with("vertex_ind"); }

  void skip(const PlyProperty& property) {
    const double count = property.isList() ? mNumbers.next(property.countType) : 1;
    for (double i = 0; i < count; ++i) mNumbers.next(property.type);
  }

  void skipElement(const PlyElement& element) {
    if (element.count > 0 && std::any_of(element.properties.begin(), element.properties.end(), isIndices))
      throw Error(fmt::format("faces in elements of kind \"{}\" are not read", element.name));
    for (std::size_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties) skip(property);
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
          v[places[k]] = mNumbers.nextCoordinate(element.properties[k].type);
        } else if (columns.propertyOf[k] != PlyColumns::kNoProperty) {
          keep(mNumbers.next(element.properties[k].type), columns.properties[columns.propertyOf[k]], i);
        } else {
          skip(element.properties[k]);
        }
      }
      mSoup.addVertex({v[0], v[1], v[2]});
      if (normals) mSoup.addNormal({v[3], v[4], v[5]});
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

  /// Calls add() for each element, with its list of indices in mCorners.
  template <typename Add>
  void readLists(const PlyElement& element, const Add& add) {
    if (element.count == 0) return;
    const auto indices = std::find_if(element.properties.begin(), element.properties.end(), isIndices);
    if (indices == element.properties.end())
      throw Error(fmt::format("elements of kind \"{}\" need a list vertex_indices", element.name));
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property != &*indices) {
          skip(property);
          continue;
        }
        mCorners.clear();
        const double count = mNumbers.next(property.countType);
        for (double k = 0; k < count; ++k) mCorners.push_back(toIndex(mNumbers.next(property.type)));
      }
      add();
    }
  }

  /// Negative numbers and those beyond what a mesh can have are for others to judge.
  std::int64_t toIndex(double number) const {
    constexpr double kLimit = 1e15;
    if (std::abs(number) < kLimit && number == std::floor(number)) return static_cast<std::int64_t>(number);
    const std::size_t line = mNumbers.line();
    throw Error(fmt::format("{}: {} is no number of a vertex",
                            line > 0 ? fmt::format("line {}", line) : fmt::format("face {}", mSoup.faces()), number));
  }

  /// Each vertex makes a triangle with the two before it, and every second one faces the other way. -1 begins a new
  /// strip. A triangle that names a vertex twice only leads to the next one.
  void addStrip() {
    std::size_t before = 0;  // vertices of the strip so far
    for (std::size_t i = 0; i < mCorners.size(); ++i) {
      before = mCorners[i] == -1 ? 0 : before + 1;
      if (before < 3) continue;
      const bool turned = before % 2 == 0;
      const std::array<std::int64_t, 3> triangle{mCorners[turned ? i - 1 : i - 2], mCorners[turned ? i - 2 : i - 1],
                                                 mCorners[i]};
      const auto& [a, b, c] = triangle;
      if (a != b && b != c && c != a) mSoup.addFace(triangle, mNumbers.line());
    }
  }

  Numbers mNumbers;
  SoupBuilder mSoup;
  std::vector<std::int64_t> mCorners;
  bool mHasVertices = false;
};

}  // namespace

ParsedMesh readPly(std::span<char> bytes, const Vec3d& shift) {
  const PlyHeader header = parsePlyHeader(bytes);
  if (header.format == PlyFormat::kAscii) return BodyReader(TextNumbers(header.body, header.lines), shift).read(header);
  const bool little = header.format == PlyFormat::kLittleEndian;
  const bool swap = little != (std::endian::native == std::endian::little);
  return BodyReader(BinaryNumbers(header.body, swap), shift).read(header);
}

}  // namespace pdc::detail
