#pragma once

#include <span>
#include <string_view>

namespace pdc::detail {

/// The three bytes that some editors put before UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Whether the first line ends with '\r' alone, as lines of old Macintosh systems do.
[[nodiscard]] bool beginsWithLoneReturn(std::string_view text);

/// Makes '\n' of each '\r' that no '\n' follows, so that '\n' ends every line.
void endLinesWithNewlines(std::span<char> text);

}  // namespace pdc::detail
