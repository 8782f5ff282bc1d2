#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "io/file/file_error.h"
#include "io/file/text_scanner.h"
#include "pdc/error.h"

namespace pdc::detail {

/// The most bytes of a file's text that an error repeats.
inline constexpr std::size_t kMostQuoted = 60;

/// "line 7: malformed vertex "v 1 0"", about the scanner's present line.
[[nodiscard]] inline Error malformed(const TextScanner& scanner, std::string_view what) {
  const std::string_view line = scanner.wholeLine();
  return Error(fmt::format("line {}: malformed {} \"{}{}\"", scanner.lineNumber(), what,
                           oneLine(line.substr(0, kMostQuoted)), line.size() > kMostQuoted ? "..." : ""));
}

}  // namespace pdc::detail
