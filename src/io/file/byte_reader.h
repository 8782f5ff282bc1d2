#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

namespace pdc::detail {

/// Reads a regular file from front to back, for one thread. Whoever asks for bytes behind the end gets an Error, and
/// nothing is allocated for them.
class ByteReader {
 public:
  /// \throws Error if the file cannot be opened, is empty or not a regular file.
  explicit ByteReader(const std::filesystem::path& path);
  ~ByteReader();
  ByteReader(const ByteReader&) = delete;
  ByteReader& operator=(const ByteReader&) = delete;

  [[nodiscard]] std::uint64_t size() const { return mSize; }
  [[nodiscard]] std::uint64_t position() const { return mPosition; }
  [[nodiscard]] std::uint64_t left() const { return mEnd - mPosition; }
  /// Moves to `position`, and makes `end` the end for what follows. \throws Error if they lie outside the file.
  void seek(std::uint64_t position, std::uint64_t end);

  void read(void* to, std::uint64_t bytes);
  void skip(std::uint64_t bytes);
  [[nodiscard]] std::string bytes(std::uint64_t count);
  template <typename Number>
  [[nodiscard]] Number get() {
    static_assert(std::is_trivially_copyable_v<Number>);
    Number value;
    read(&value, sizeof(Number));
    return value;
  }
  /// Reads an unsigned 32-bit length and as many bytes.
  [[nodiscard]] std::string string();

 private:
  void require(std::uint64_t bytes) const;
  void fill();

  int mDescriptor = -1;
  std::uint64_t mSize = 0, mEnd = 0, mPosition = 0;
  std::uint64_t mBufferBegin = 0, mBufferEnd = 0;  ///< The part of the file that the buffer holds.
  std::vector<char> mBuffer;
};

}  // namespace pdc::detail
