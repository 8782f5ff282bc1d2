#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace pdc::detail {

/// 128 bits that differ for different bytes, but for a chance of 2^-128; not against those who want them equal.
using Hash128 = std::array<std::uint64_t, 2>;

[[nodiscard]] Hash128 hashOf(std::span<const char> bytes);
[[nodiscard]] Hash128 hashOf(std::span<const std::uint64_t> words);

/// Thirty-two hexadecimal digits.
[[nodiscard]] std::string hashText(const Hash128& hash);

/// The hash of bytes that come one after the other.
class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;

  void add(const void* data, std::size_t size);
  /// That of all bytes so far.
  [[nodiscard]] Hash128 hash() const;

 private:
  struct State;
  std::unique_ptr<State> mState;
};

}  // namespace pdc::detail
