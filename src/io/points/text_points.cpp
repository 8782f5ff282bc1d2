#include "io/points/text_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "io/file/line_ends.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kMostColumns = 10;

/// Where in a line what stands; 0 for what there is not.
struct Columns {
  std::size_t normal = 0, colour = 0;
};

class TextPoints {
 public:
  explicit TextPoints(std::string_view text) : mScanner(text) {}

  PointCloud read() {
    bool any = mScanner.nextLine();
    if (any && takeCount()) any = mScanner.nextLine();
    for (; any; any = mScanner.nextLine()) addLine();
    const std::size_t n = mCloud.positions.size();
    if (mAnnounced && *mAnnounced != n)
      throw Error(fmt::format("{} points were announced in line 1; there are {}", *mAnnounced, n));
    return std::move(mCloud);
  }

 private:
  /// Whether the line is a single whole number, which is how many points follow.
  bool takeCount() {
    const std::string_view line = mScanner.wholeLine();
    if (line.find_first_not_of("0123456789") != std::string_view::npos) return false;
    mAnnounced = TextScanner::parse<std::size_t>(line);
    return mAnnounced.has_value();
  }

  void addLine() {
    std::array<double, kMostColumns> number{};
    std::size_t count = 0;
    while (!mScanner.restOfLine().empty()) {
      const std::optional<double> value = TextScanner::parse<double>(mScanner.word());
      if (!value || count == kMostColumns) throw malformed(mScanner, "point");
      number[count++] = *value;
    }
    if (mCount == 0) setColumns({number.data(), count});
    if (count != mCount)
      throw Error(fmt::format("line {} has {} numbers; the first point has {}", mScanner.lineNumber(), count, mCount));
    mCloud.positions.push_back({number[0], number[1], number[2]});
    const std::size_t n = mColumns.normal, c = mColumns.colour;
    if (n != 0) mCloud.normals.push_back(vecCast<float>(Vec3d{number[n], number[n + 1], number[n + 2]}));
    if (c != 0) mCloud.colours.push_back({toByte(number[c]), toByte(number[c + 1]), toByte(number[c + 2])});
  }

  void setColumns(std::span<const double> first) {
    mCount = first.size();
    const auto isColour = [&](std::size_t at) {
      const std::span<const double> three = first.subspan(at, 3);
      const auto isByte = [](double v) { return v >= 0 && v <= 255 && v == std::floor(v); };
      return std::all_of(three.begin(), three.end(), isByte) && *std::max_element(three.begin(), three.end()) > 1;
    };
    switch (mCount) {
      case 3:
      case 4:
        return;
      case 6:
        isColour(3) ? mColumns.colour = 3 : mColumns.normal = 3;
        return;
      case 7:
        mColumns.colour = 4;
        return;
      case 9:
        mColumns = isColour(3) ? Columns{6, 3} : Columns{3, 6};
        return;
      case 10:
        mColumns = {.normal = 7, .colour = 4};
        return;
      default:
        throw Error(
            fmt::format("line {} has {} numbers; a point has 3, 4, 6, 7, 9 or 10", mScanner.lineNumber(), mCount));
    }
  }

  static std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); }

  TextScanner mScanner;
  std::optional<std::size_t> mAnnounced;
  std::size_t mCount = 0;  ///< Of numbers in a line.
  Columns mColumns;
  PointCloud mCloud;
};

}  // namespace

PointCloud readTextPoints(std::span<char> bytes) {
  if (beginsWithLoneReturn({bytes.data(), bytes.size()})) endLinesWithNewlines(bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == ',' || bytes[i] == ';') bytes[i] = ' ';
    if (bytes[i] == '/' && i + 1 < bytes.size() && bytes[i + 1] == '/') bytes[i] = '#';
  }
  const std::string_view text(bytes.data(), bytes.size());
  if (text.find('\0') != std::string_view::npos) throw Error("is binary, and not points as text");
  return TextPoints(text).read();
}

}  // namespace pdc::detail
