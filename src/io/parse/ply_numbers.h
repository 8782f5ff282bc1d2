#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "io/file/file_error.h"
#include "io/file/text_scanner.h"
#include "io/parse/malformed.h"
#include "io/parse/ply_header.h"
#include "pdc/error.h"

namespace pdc::detail {

// Both go through the numbers of a PLY file's body one after the other. Numbers come as double, which holds all of
// PLY's types.

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
  double nextCoordinate(PlyType type) { return next(type); }

  /// The line of the latest number; 0, since there are no lines.
  [[nodiscard]] std::size_t line() const { return 0; }
  /// How much is left.
  [[nodiscard]] std::size_t left() const { return mBody.size(); }

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
  TextNumbers(std::string_view body, std::size_t linesBefore) : mScanner(body, '\0'), mLinesBefore(linesBefore) {}

  double next(PlyType type) {
    const std::string_view word = nextWord();
    // Read as what it is: from decimal to double to float would round twice.
    return type == PlyType::kFloat32 ? valueOf(TextScanner::parse<float>(word), word)
                                     : valueOf(TextScanner::parse<double>(word), word);
  }
  /// In double precision, whatever the type.
  double nextCoordinate(PlyType /*type*/) {
    const std::string_view word = nextWord();
    return valueOf(TextScanner::parseCoordinate(word), word);
  }

  /// The line of the latest number.
  [[nodiscard]] std::size_t line() const { return mLinesBefore + mScanner.lineNumber(); }
  /// How much is left but blanks.
  [[nodiscard]] std::size_t left() {
    const bool more = !mScanner.restOfLine().empty() || mScanner.nextLine();
    return more ? mScanner.restOfLine().size() + mScanner.rest().size() : 0;
  }

 private:
  std::string_view nextWord() {
    if (mScanner.restOfLine().empty() && !mScanner.nextLine())
      throw Error("ends before the last of the elements announced in its header");
    return mScanner.word();
  }

  template <typename Number>
  double valueOf(std::optional<Number> number, std::string_view word) const {
    if (!number)
      throw Error(fmt::format("line {}: \"{}\" is not a number", line(), oneLine(word.substr(0, kMostQuoted))));
    return static_cast<double>(*number);
  }

  TextScanner mScanner;
  std::size_t mLinesBefore;
};

}  // namespace pdc::detail
