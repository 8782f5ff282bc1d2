#include "io/parse/off_header.h"

#include <string>

#include "io/file/suffix.h"

namespace pdc::detail {

std::optional<OffKind> offKind(std::string_view word) {
  const std::string lower = lowerCase(word);
  const std::size_t off = lower.find("off");
  if (off == std::string::npos) return std::nullopt;
  const std::size_t end = off + 3;
  OffKind kind{.after = word.substr(end)};
  if (!kind.after.empty() && (kind.after.front() < '0' || kind.after.front() > '9')) return std::nullopt;

  std::string_view letters = std::string_view(lower).substr(0, off);
  const auto take = [&letters](std::string_view letter) {
    const bool there = letters.starts_with(letter);
    if (there) letters.remove_prefix(letter.size());
    return there;
  };
  take("st");
  take("c");
  const bool allLower = word.substr(0, end) == std::string_view(lower).substr(0, end);
  if (!letters.empty()) kind.normals = (word[off - letters.size()] == 'N' || allLower) && take("n");
  kind.homogeneous = take("4");
  kind.anyDimension = take("n");
  return letters.empty() ? std::optional(kind) : std::nullopt;
}

}  // namespace pdc::detail
