#pragma once

#include <bit>
#include <cstdint>

namespace pdc::detail {

/// Calls write(i, bit) for i = 0, 1, … and the set bits of a word, ascending; then for at most kAtOnce further i with
/// bit 64, where write must do no harm: a loop whose end the processor cannot foresee costs more than a few writes in
/// vain. Call it within forEachBatch() or withSimd(), so that it gets the processor's instructions for bits. \returns
/// the number of set bits.
template <int kAtOnce, typename Write>
int writeBits(std::uint64_t word, Write&& write) {
  const int count = std::popcount(word);
  int n = 0;
  do {
    for (int i = 0; i < kAtOnce; ++i, word &= word - 1) write(n + i, std::countr_zero(word));
    n += kAtOnce;
  } while (n < count);
  return count;
}

}  // namespace pdc::detail
