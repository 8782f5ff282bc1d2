#include "io/file/line_ends.h"

#include <cstring>

namespace pdc::detail {

bool beginsWithLoneReturn(std::string_view text) {
  const std::size_t end = text.find_first_of("\r\n");
  return end != std::string_view::npos && text[end] == '\r' && (end + 1 == text.size() || text[end + 1] != '\n');
}

void endLinesWithNewlines(std::span<char> text) {
  char* const end = text.data() + text.size();
  for (char* next = text.data(); next != end; ++next) {
    next = static_cast<char*>(std::memchr(next, '\r', static_cast<std::size_t>(end - next)));
    if (next == nullptr) return;
    if (next + 1 == end || next[1] != '\n') *next = '\n';
  }
}

}  // namespace pdc::detail
