#include "simplify/clustering/key_numbers.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "pdc/error.h"

namespace pdc::detail {

std::uint32_t KeyNumbers::insert(std::uint64_t key, std::size_t slot) {
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  if (mSize == kMost) throw Error(fmt::format("the triangles meet more than {} cells: choose larger ones", kMost));
  mSlots[slot] = {key, mSize++};
  if (2 * std::size_t{mSize} > mSlots.size()) grow();
  return mSize - 1;
}

void KeyNumbers::grow() {
  const std::vector<Slot> old = std::exchange(mSlots, std::vector<Slot>(2 * mSlots.size()));
  --mShift;
  for (const Slot& slot : old) {
    if (slot.key == kNoKey) continue;
    std::size_t i = slotOf(slot.key);
    while (mSlots[i].key != kNoKey) i = (i + 1) & (mSlots.size() - 1);
    mSlots[i] = slot;
  }
}

}  // namespace pdc::detail
