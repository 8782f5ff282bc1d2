#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Goes through a text line by line and through a line word by word. Words are separated by blanks. A line ends at
/// '\n'; a '\r' before it counts as a blank, and so does everything from `comment` on ('\0': there are no comments).
class TextScanner {
 public:
  /// \param continued whether a line that ends with '\\', before any comment, goes on in the next.
  explicit TextScanner(std::string_view text, char comment = '#', bool continued = false)
      : mText(text), mComment(comment), mContinued(continued) {}

  /// Goes to the next line that has a word. \returns false at the end of the text.
  bool nextLine() {
    while (!mText.empty()) {
      takeLine();
      skipBlanks();
      if (!mLine.empty()) return true;
    }
    mLine = {};
    return false;
  }

  /// Takes the next word of the line; it is empty at the line's end. Valid until the next line is taken.
  std::string_view word() {
    std::size_t size = 0;
    while (size < mLine.size() && !isBlank(mLine[size])) ++size;
    return take(size);
  }

  /// Takes the next word as a number. \returns nothing, and takes nothing, if it is none.
  template <typename Number>
  std::optional<Number> number() {
    const char *const begin = mLine.data() + mLine.starts_with('+'), *const end = mLine.data() + mLine.size();
    Number value{};
    const auto [next, error] = std::from_chars(begin, end, value);
    if (error != std::errc{} || (next != end && !isBlank(*next))) return std::nullopt;
    take(static_cast<std::size_t>(next - mLine.data()));
    return value;
  }

  /// Takes the next three words as coordinates, see parseCoordinate(). \returns nothing if one is no number.
  std::optional<Vec3d> point() {
    Vec3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view before = mLine;
      const auto value = number<double>();
      if (!value) return std::nullopt;
      p[axis] = isBetweenFloats(*value) ? turnedToFloat(*value, before) : *value;
    }
    return p;
  }

  /// The whole of `text` as a number. Numbers beyond the range of float become infinite or zero if double holds them.
  template <typename Number>
  static std::optional<Number> parse(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    if constexpr (std::is_same_v<Number, float>) {
      if (error == std::errc::result_out_of_range) {
        const auto wide = parse<double>(text);
        return wide ? std::optional(static_cast<float>(*wide)) : std::nullopt;
      }
    }
    return error == std::errc{} && next == end ? std::optional(value) : std::nullopt;
  }

  /// The whole of `text` in double precision, such that a cast to float gives the float nearest to the text.
  static std::optional<double> parseCoordinate(std::string_view text) {
    const auto value = parse<double>(text);
    return value && isBetweenFloats(*value) ? std::optional(turnedToFloat(*value, text)) : value;
  }

  /// The number of the line, from 1; 0 before the first. Of a continued line, that of its last.
  [[nodiscard]] std::size_t lineNumber() const { return mLineNumber; }
  /// What was not yet taken of the line.
  [[nodiscard]] std::string_view restOfLine() const { return mLine; }
  /// The line as it was before any of it was taken, without its comment.
  [[nodiscard]] std::string_view wholeLine() const { return mWholeLine; }
  /// The text after the line.
  [[nodiscard]] std::string_view rest() const { return mText; }

 private:
  /// Whether it lies halfway between two floats.
  static bool isBetweenFloats(double value) {
    constexpr std::uint64_t kBelowFloat = (std::uint64_t{1} << 29) - 1, kHalf = std::uint64_t{1} << 28;
    return (std::bit_cast<std::uint64_t>(value) & kBelowFloat) == kHalf;
  }

  /// Where rounding to double ended halfway between two floats, turns the last bit to the side on which the number is
  /// that `text` begins with.
  static double turnedToFloat(double value, std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    float nearest = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), nearest);
    const bool differs = result.ec == std::errc{} && nearest != static_cast<float>(value);
    return differs ? std::nextafter(value, static_cast<double>(nearest)) : value;
  }

  std::string_view take(std::size_t size) {
    const std::string_view result = mLine.substr(0, size);
    mLine.remove_prefix(size);
    skipBlanks();
    return result;
  }

  static bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skipBlanks() {
    std::size_t begin = 0;
    while (begin < mLine.size() && isBlank(mLine[begin])) ++begin;
    mLine.remove_prefix(begin);
  }

  void takeLine() {
    takeUntilNewline();
    if (mContinued && endsWithBackslash()) joinLines();
    mWholeLine = mLine;
  }

  void takeUntilNewline() {
    const std::size_t end = mText.find('\n');
    mLine = mText.substr(0, end);
    mText.remove_prefix(end == std::string_view::npos ? mText.size() : end + 1);
    ++mLineNumber;
    mLine = mLine.substr(0, mLine.find(mComment));
    while (!mLine.empty() && isBlank(mLine.back())) mLine.remove_suffix(1);
  }

  [[nodiscard]] bool endsWithBackslash() const { return !mLine.empty() && mLine.back() == '\\'; }

  void joinLines() {
    mJoined.clear();
    while (endsWithBackslash()) {
      mLine.remove_suffix(1);
      mJoined.append(mLine).push_back(' ');
      takeUntilNewline();
    }
    mJoined.append(mLine);
    mLine = mJoined;
  }

  std::string_view mText, mLine, mWholeLine;
  std::string mJoined;  ///< A continued line.
  char mComment;
  bool mContinued;
  std::size_t mLineNumber = 0;
};

}  // namespace pdc::detail
