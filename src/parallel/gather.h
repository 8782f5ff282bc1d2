#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pdc::detail {

/// Calls visit(i, out) for i from 0 to n - 1, in parallel. \returns what the calls appended to `out`, in the order of
/// i.
template <typename T, typename Visit>
std::vector<T> gather(std::size_t n, Visit&& visit) {
  constexpr std::size_t kChunk = 32;
  std::vector<std::vector<T>> part((n + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, part.size(), [&](std::size_t p) {
    for (std::size_t i = p * kChunk; i < std::min(n, (p + 1) * kChunk); ++i) visit(i, part[p]);
  });
  std::vector<T> all;
  for (const std::vector<T>& some : part) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace pdc::detail
