#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/text_scanner.h"
#include "pdc/error.h"
#include "pdc/math/vec3.h"

namespace pdc::detail {

/// The text without blanks at its ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// The words of a line, between blanks.
[[nodiscard]] inline std::vector<std::string_view> wordsOf(std::string_view line) {
  TextScanner scanner(line, '\0');
  std::vector<std::string_view> words;
  if (!scanner.nextLine()) return words;
  for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) words.push_back(word);
  return words;
}

/// A text that is a number. \param field how errors call it. \throws Error.
template <typename Number>
[[nodiscard]] Number numberIn(std::string_view text, std::string_view field) {
  const auto number = TextScanner::parse<Number>(trimmed(text));
  constexpr std::size_t kMostQuoted = 60;
  if (!number) throw Error(fmt::format("{}: \"{}\" is no number", field, oneLine(text.substr(0, kMostQuoted))));
  return *number;
}

/// As many numbers between blanks as `count` says. \throws Error for fewer, more or others.
template <typename Number>
[[nodiscard]] std::vector<Number> numbersIn(std::string_view text, std::string_view field, std::size_t count) {
  const std::vector<std::string_view> words = wordsOf(text);
  if (words.size() != count)
    throw Error(fmt::format("{}: {} values are there, {} are needed", field, words.size(), count));
  std::vector<Number> numbers;
  for (const std::string_view word : words) numbers.push_back(numberIn<Number>(word, field));
  return numbers;
}

}  // namespace pdc::detail
