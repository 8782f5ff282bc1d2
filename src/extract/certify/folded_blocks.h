#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pdc::detail {

/// The blocks whose faces noise has folded: those with more than `most` offences. It is counted by blocks, so that a
/// part of a volume is certified as the whole is.
class FoldedBlocks {
 public:
  /// \param ofOffences the block of each offence, in any order.
  FoldedBlocks(std::vector<std::int32_t> ofOffences, std::ptrdiff_t most) {
    std::sort(ofOffences.begin(), ofOffences.end());
    for (auto begin = ofOffences.begin(); begin != ofOffences.end();) {
      const auto end = std::find_if(begin, ofOffences.end(), [&](std::int32_t b) { return b != *begin; });
      if (end - begin > most) mBlocks.push_back(*begin);
      begin = end;
    }
  }

  [[nodiscard]] bool has(std::int32_t block) const { return std::binary_search(mBlocks.begin(), mBlocks.end(), block); }

 private:
  std::vector<std::int32_t> mBlocks;  ///< Sorted.
};

}  // namespace pdc::detail
