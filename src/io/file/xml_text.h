#pragma once

#include <string>
#include <string_view>

namespace pdc::detail {

/// Text as it stands in XML, in an attribute too. Control characters, which XML does not have, become blanks.
[[nodiscard]] inline std::string xmlText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

}  // namespace pdc::detail
