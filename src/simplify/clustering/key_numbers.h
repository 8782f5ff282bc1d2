#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pdc::detail {

/// Numbers keys from 0 on, in the order in which they first appear: a hash table with open addressing.
class KeyNumbers {
 public:
  KeyNumbers() : mSlots(kFirstSlots) {}

  [[nodiscard]] std::uint32_t size() const { return mSize; }

  /// The number of a key, which becomes size() if it is new. \param key not kNoKey.
  std::uint32_t numberOf(std::uint64_t key) {
    for (std::size_t i = slotOf(key);; i = (i + 1) & (mSlots.size() - 1)) {
      if (mSlots[i].key == key) return mSlots[i].number;
      if (mSlots[i].key == kNoKey) return insert(key, i);
    }
  }

  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};

 private:
  struct Slot {
    std::uint64_t key = kNoKey;
    std::uint32_t number = 0;
  };
  static constexpr std::size_t kFirstSlots = std::size_t{1} << 12;

  /// The upper bits of the product depend on all bits of the key (Knuth's multiplicative hashing).
  [[nodiscard]] std::size_t slotOf(std::uint64_t key) const { return (key * 0x9E3779B97F4A7C15U) >> mShift; }
  /// \throws Error if there are no numbers left.
  std::uint32_t insert(std::uint64_t key, std::size_t slot);
  void grow();

  std::vector<Slot> mSlots;  ///< A power of two, half of them empty.
  int mShift = 64 - 12;
  std::uint32_t mSize = 0;
};

}  // namespace pdc::detail
