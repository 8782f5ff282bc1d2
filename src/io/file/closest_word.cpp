#include "io/file/closest_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "io/file/suffix.h"

namespace pdc::detail {
namespace {

/// How many letters have to be put in, left out, changed or exchanged with a neighbour to make b of a.
std::size_t editDistance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between beginnings: two above the present one are needed.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = above;
    above = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({changed, above[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string closestWord(std::string_view word, std::span<const std::string> known) {
  const std::string lower = lowerCase(word);
  std::string closest;
  std::size_t least = 0;
  for (const std::string& candidate : known) {
    const std::string other = lowerCase(candidate);
    // A third of the letters may be wrong; and the beginning of one word alone may be meant.
    const std::size_t most = std::max<std::size_t>(1, std::max(lower.size(), other.size()) / 3);
    std::size_t distance = editDistance(lower, other);
    if (lower.size() >= 3 && other.starts_with(lower)) distance = std::min(distance, most);
    if (distance <= most && (closest.empty() || distance < least)) {
      closest = candidate;
      least = distance;
    }
  }
  return closest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> known) {
  const std::string closest = closestWord(word, known);
  return closest.empty() ? "" : fmt::format(" (did you mean '{}'?)", closest);
}

}  // namespace pdc::detail
