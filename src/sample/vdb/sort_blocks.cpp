#include "sample/vdb/sort_blocks.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>

namespace pdc::detail {
namespace {

template <typename T>
void sortUniqueValues(std::vector<T>& values) {
  tbb::parallel_sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

void sortUnique(std::vector<Coord>& blocks) {
  if (blocks.empty()) return;
  Coord low = blocks[0], high = blocks[0];
  for (const Coord& b : blocks)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], b[i]);
      high[i] = std::max(high[i], b[i]);
    }
  // Single numbers are sorted several times as fast, where coordinates fit into one.
  constexpr int kBits = 21;
  bool packs = true;
  for (int i = 0; i < 3; ++i) packs = packs && std::int64_t{high[i]} - low[i] < std::int64_t{1} << kBits;
  if (!packs) {
    sortUniqueValues(blocks);
    return;
  }
  const auto part = [&](const Coord& b, int i) { return static_cast<std::uint64_t>(b[i] - low[i]); };
  std::vector<std::uint64_t> keys(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i)
    keys[i] = part(blocks[i], 0) << 2 * kBits | part(blocks[i], 1) << kBits | part(blocks[i], 2);
  sortUniqueValues(keys);
  blocks.resize(keys.size());
  constexpr std::uint64_t kPart = (std::uint64_t{1} << kBits) - 1;
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (int k = 0; k < 3; ++k) blocks[i][k] = low[k] + static_cast<std::int32_t>(keys[i] >> (2 - k) * kBits & kPart);
}

}  // namespace pdc::detail
