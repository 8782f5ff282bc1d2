#include "parallel/machine_memory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace pdc::detail {
namespace {

TEST(MachineMemory, WhatIsTakenIsInUse) {
  constexpr std::size_t kMega = 1 << 20;
  const std::size_t before = memoryInUse();
  ASSERT_GT(before, kMega);
  std::vector<char> taken(100 * kMega);
  std::memset(taken.data(), 1, taken.size());
  EXPECT_GT(memoryInUse(), before + 80 * kMega);
  EXPECT_GE(peakMemory(), before + 80 * kMega);
  EXPECT_EQ(taken.back(), 1);
}

TEST(MachineMemory, SomeIsAvailable) { EXPECT_GT(availableMemory(), std::size_t{1} << 26); }

TEST(MachineMemory, FiguresAreOneLine) {
  const std::string text = memoryFigures();
  EXPECT_NE(text.find(" MB were in use, "), std::string::npos);
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace pdc::detail
