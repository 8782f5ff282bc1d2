#include "simplify/clustering/key_numbers.h"

#include <gtest/gtest.h>

#include <random>
#include <unordered_map>

namespace pdc::detail {
namespace {

TEST(KeyNumbers, NumbersKeysInTheOrderOfTheirAppearance) {
  KeyNumbers numbers;
  std::unordered_map<std::uint64_t, std::uint32_t> expected;
  std::mt19937_64 engine(3);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t key = engine() % 30'000 << (i % 3 * 21);
    const auto [it, isNew] = expected.try_emplace(key, static_cast<std::uint32_t>(expected.size()));
    ASSERT_EQ(numbers.numberOf(key), it->second);
    ASSERT_EQ(numbers.size(), expected.size());
  }
  for (const auto& [key, number] : expected) ASSERT_EQ(numbers.numberOf(key), number);
}

}  // namespace
}  // namespace pdc::detail
