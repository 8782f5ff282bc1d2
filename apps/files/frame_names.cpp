#include "files/frame_names.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace pdc {
namespace {

/// A whole number from 0 that is all of a text.
std::optional<int> wholeNumber(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool all = !text.empty() && text[0] != '-' && error == std::errc() && end == text.data() + text.size();
  return all ? std::optional(number) : std::nullopt;
}

/// The digits that "d" or "0Nd" at a place ask for, and how long that is; none if something else stands there.
struct NumberPlace {
  int digits;
  std::size_t size;
};
std::optional<NumberPlace> numberPlace(std::string_view text) {
  if (text.starts_with("d")) return NumberPlace{1, 1};
  const bool digit = text.size() >= 3 && text[1] >= '1' && text[1] <= '9';
  if (!digit || text[0] != '0' || text[2] != 'd') return std::nullopt;
  return NumberPlace{text[1] - '0', 3};
}

}  // namespace

std::vector<int> FrameRange::numbers() const {
  std::vector<int> all;
  for (long long frame = first; frame <= last; frame += step) all.push_back(static_cast<int>(frame));
  return all;
}

FrameRange parseFrames(const std::string& text) {
  const std::string_view whole = text;
  const std::size_t colon = whole.find(':'), dash = whole.substr(0, colon).find('-');
  const std::string_view range = whole.substr(0, colon);
  const auto first = wholeNumber(range.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : wholeNumber(range.substr(dash + 1));
  const auto step = colon == std::string_view::npos ? std::optional(1) : wholeNumber(whole.substr(colon + 1));
  if (!first || !last || !step || *step == 0 || *last < *first)
    throw CLI::ValidationError(
        "--frames", fmt::format("'{}' is not A-B or A-B:STEP, whole numbers with 0 <= A <= B and STEP >= 1", text));
  constexpr int kMost = 1'000'000;
  if ((*last - *first) / *step >= kMost)
    throw CLI::ValidationError("--frames", fmt::format("'{}' are more than {} frames", text, kMost));
  return {*first, *last, *step};
}

FrameNames::FrameNames(const std::string& pattern, const char* argument) {
  const auto refuse = [&](const char* what) {
    throw CLI::ValidationError(argument, fmt::format("'{}' {}, as %d or %04d", pattern, what));
  };
  bool found = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::string& text = found ? mAfter : mBefore;
    if (pattern[i] != '%') {
      text += pattern[i];
      continue;
    }
    const std::string_view rest = std::string_view(pattern).substr(i + 1);
    if (rest.starts_with("%")) {
      text += '%';
      ++i;
      continue;
    }
    const auto place = numberPlace(rest);
    if (!place) refuse("has a % that is no place for a frame's number");
    if (found) refuse("has more than one place for a frame's number");
    found = true;
    mDigits = place->digits;
    i += place->size;
  }
  if (!found) refuse("has no place for a frame's number");
}

std::string FrameNames::of(int frame) const { return fmt::format("{}{:0{}}{}", mBefore, frame, mDigits, mAfter); }

}  // namespace pdc
