#pragma once

#include <charconv>
#include <cstddef>

#include "io/file/chunked_output.h"

namespace pdc::detail {

/// Writes text into the end of a buffer that was made large enough beforehand.
class TextCursor {
 public:
  /// Room for any double or index in decimal, at most -2.2250738585072014e-308, and a separator.
  static constexpr std::size_t kMaxNumber = 25;

  /// Takes over the buffer until finish(); `capacity` bytes must be enough for all that is written.
  TextCursor(ChunkBuffer& buffer, std::size_t capacity) : mBuffer(buffer) {
    mBuffer.resize(capacity);
    mNext = mBuffer.data();
  }
  void finish() { mBuffer.resize(static_cast<std::size_t>(mNext - mBuffer.data())); }

  void put(char c) { *mNext++ = c; }
  /// Writes the shortest decimal that reads back to the same value.
  template <typename Number>
  void put(Number number) {
    mNext = std::to_chars(mNext, mNext + kMaxNumber, number).ptr;
  }

 private:
  ChunkBuffer& mBuffer;
  char* mNext;
};

}  // namespace pdc::detail
