#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace pdc::detail {

/// Goes through a text line by line and through a line word by word. Words are separated by blanks. A line ends at
/// '\n'; a '\r' before it counts as a blank, and so does everything from `comment` on ('\0': there are no comments).
class TextScanner {
 public:
  explicit TextScanner(std::string_view text, char comment = '#') : mText(text), mComment(comment) {}

  /// Goes to the next line that has a word. \returns false at the end of the text.
  bool nextLine() {
    while (!mText.empty()) {
      const std::size_t end = mText.find('\n');
      mLine = mText.substr(0, end);
      mText.remove_prefix(end == std::string_view::npos ? mText.size() : end + 1);
      ++mLineNumber;
      mLine = mLine.substr(0, mLine.find(mComment));
      skipBlanks();
      if (!mLine.empty()) return true;
    }
    mLine = {};
    return false;
  }

  /// Takes the next word of the line; it is empty at the line's end.
  std::string_view word() {
    std::size_t size = 0;
    while (size < mLine.size() && !isBlank(mLine[size])) ++size;
    const std::string_view result = mLine.substr(0, size);
    mLine.remove_prefix(size);
    skipBlanks();
    return result;
  }

  /// Takes the next word as a number. \returns nothing if it is none.
  template <typename Number>
  std::optional<Number> number() {
    return parse<Number>(word());
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

  /// The number of the line, from 1; 0 before the first.
  [[nodiscard]] std::size_t lineNumber() const { return mLineNumber; }
  /// The text after the line.
  [[nodiscard]] std::string_view rest() const { return mText; }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

  void skipBlanks() {
    std::size_t begin = 0;
    while (begin < mLine.size() && isBlank(mLine[begin])) ++begin;
    mLine.remove_prefix(begin);
  }

  std::string_view mText, mLine;
  char mComment;
  std::size_t mLineNumber = 0;
};

}  // namespace pdc::detail
