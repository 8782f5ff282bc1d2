#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pdc::detail {

/// The text with A to Z in lower case; all other bytes stay, whatever the locale.
[[nodiscard]] inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// The suffix of a file's name in lower case, with its dot; empty if there is none.
[[nodiscard]] inline std::string suffixOf(const std::filesystem::path& path) {
  return lowerCase(path.extension().string());
}

}  // namespace pdc::detail
