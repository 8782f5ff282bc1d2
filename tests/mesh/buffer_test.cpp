#include "pdc/mesh/buffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

namespace pdc {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

struct WithInitialValue {
  std::uint32_t value = 7;
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
  for (int i = 0; i < 3; ++i) {
    Buffer<char> a(50 * kMebibyte), b(40 * kMebibyte), c(60 * kMebibyte);
    EXPECT_EQ(keptMemory(), 0u) << i;
    // c and b are freed last to first, then a finds no room for all three.
    Buffer<char>().swap(c);
    Buffer<char>().swap(b);
    Buffer<char>().swap(a);
    EXPECT_LE(keptMemory(), kKeptMemory);
    EXPECT_EQ(keptMemory(), (52 + 40) * kMebibyte);
    releaseMemory();
  }
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

TEST_F(BufferTest, ResizeDoesNotClear) {
  Buffer<std::uint32_t>(kMebibyte, 3u).clear();
  Buffer<WithInitialValue> again(kMebibyte);
  EXPECT_EQ(again[1000].value, 3u);
  again.assign(kMebibyte, WithInitialValue{});
  EXPECT_EQ(again[1000].value, 7u);
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
