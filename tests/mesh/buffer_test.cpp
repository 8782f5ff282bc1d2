#include "pdc/mesh/buffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <thread>

namespace pdc {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

/// Copied byte by byte, though not made so.
struct CountsConstructions {
  static inline int gConstructions = 0;
  std::uint32_t value = 7;
  CountsConstructions() { ++gConstructions; }
};

/// A test starts without kept memory and leaves none.
class BufferTest : public testing::Test {
 protected:
  BufferTest() { releaseMemory(); }
  ~BufferTest() override { releaseMemory(); }
};

TEST_F(BufferTest, MemoryOfAFreedArrayServesTheNextOfAboutItsSize) {
  const void* first = nullptr;
  {
    const Buffer<char> array(20 * kMebibyte);
    first = array.data();
  }
  EXPECT_EQ(keptMemory(), 20 * kMebibyte);
  const Buffer<float> next(5 * kMebibyte - 1000);
  EXPECT_EQ(static_cast<const void*>(next.data()), first);
  EXPECT_EQ(keptMemory(), 0u);
}

TEST_F(BufferTest, SmallArraysAreNotKept) {
  Buffer<char>(kMebibyte / 4).clear();
  EXPECT_EQ(keptMemory(), 0u);
}

TEST_F(BufferTest, KeepsTheNewestAsFarAsThereIsRoom) {
  const void *memoryOfA = nullptr, *memoryOfB = nullptr;
  {
    Buffer<char> a(50 * kMebibyte), b(40 * kMebibyte), c(60 * kMebibyte);
    EXPECT_EQ(keptMemory(), 0u);
    memoryOfA = a.data();
    memoryOfB = b.data();
    // With all three there would be too much when the last one, a, is freed.
    Buffer<char>().swap(c);
    Buffer<char>().swap(b);
    Buffer<char>().swap(a);
  }
  EXPECT_LE(keptMemory(), kKeptMemory);
  EXPECT_GE(keptMemory(), 90 * kMebibyte);
  const Buffer<char> a(50 * kMebibyte), b(40 * kMebibyte);
  EXPECT_EQ(static_cast<const void*>(a.data()), memoryOfA);
  EXPECT_EQ(static_cast<const void*>(b.data()), memoryOfB);
  EXPECT_EQ(keptMemory(), 0u) << "the oldest, c, was given back";
}

TEST_F(BufferTest, ArraysLargerThanAllThatIsKeptAreNotKept) {
  Buffer<char>(kKeptMemory + 1).clear();
  EXPECT_EQ(keptMemory(), 0u);
}

TEST_F(BufferTest, ReleaseGivesAllBack) {
  Buffer<char>(3 * kMebibyte).clear();
  Buffer<char>(30 * kMebibyte).clear();
  EXPECT_GT(keptMemory(), 0u);
  releaseMemory();
  EXPECT_EQ(keptMemory(), 0u);
}

TEST_F(BufferTest, ResizeConstructsNoElementsThatAreCopiedByteByByte) {
  Buffer<CountsConstructions> array;
  CountsConstructions::gConstructions = 0;
  array.resize(1000);
  EXPECT_EQ(CountsConstructions::gConstructions, 0);
  array.assign(1000, CountsConstructions{});
  EXPECT_EQ(CountsConstructions::gConstructions, 1) << "of which all others are copies";
  EXPECT_EQ(array[999].value, 7u);
}

TEST_F(BufferTest, ResizeConstructsAllOtherElements) {
  Buffer<std::string> array;
  array.resize(1000);
  EXPECT_EQ(array[999], "");
}

TEST_F(BufferTest, ResizeKeepsWhatIsThere) {
  Buffer<std::uint32_t> array(1000, 3u);
  array.resize(kMebibyte);
  EXPECT_EQ(array[0], 3u);
  EXPECT_EQ(array[999], 3u);
}

TEST_F(BufferTest, ThreadsDoNotShareMemoryThatIsInUse) {
  const auto work = [](std::uint32_t mark) {
    for (int i = 0; i < 200; ++i) {
      const Buffer<std::uint32_t> a(kMebibyte / 4, mark);
      EXPECT_EQ(a.front(), mark);
      EXPECT_EQ(a.back(), mark);
    }
  };
  std::thread first(work, 1), second(work, 2);
  first.join();
  second.join();
}

}  // namespace
}  // namespace pdc
