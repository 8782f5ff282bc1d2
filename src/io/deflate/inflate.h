#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "pdc/mesh/buffer.h"
#include "pdc/monitor.h"

/// Errors of these functions do not name the file: their callers do.
namespace pdc::detail {

/// What lies around deflated bytes.
enum class DeflateWrapping {
  kGzipOrZlib,  ///< The header of either; several gzip streams may follow each other.
  kNone,        ///< Nothing, as in zip files.
};

/// Whether so many deflated bytes can become `inflated` bytes at all: the format holds at most 1032 a byte.
[[nodiscard]] constexpr bool canInflateTo(std::uint64_t deflated, std::uint64_t inflated) {
  return inflated / 1032 <= deflated;
}

/// Inflates bytes in memory from front to back, for one thread.
class InflateStream {
 public:
  explicit InflateStream(std::span<const char> bytes, DeflateWrapping wrapping = DeflateWrapping::kGzipOrZlib);
  ~InflateStream();
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;

  /// \returns how many bytes there were: fewer than asked for at the end only. \throws Error for damaged bytes.
  std::size_t readSome(void* to, std::size_t bytes);
  /// Fills `to`, in the stage "reading". \throws Error if there are fewer bytes; Cancelled.
  void read(std::span<char> to, const Monitor& monitor = {});
  /// Passes over bytes. \throws as read().
  void skip(std::uint64_t bytes, const Monitor& monitor = {});
  /// The share of the deflated bytes that was used.
  [[nodiscard]] double share() const;

 private:
  struct State;
  void beginNext();

  std::unique_ptr<State> mState;
  std::span<const char> mBytes;
  std::size_t mUsed = 0;
  bool mWrapped, mEnded = false;
};

/// All that a gzip or zlib stream holds. \throws Error for damaged bytes.
[[nodiscard]] Buffer<char> inflateAll(std::span<const char> bytes);

}  // namespace pdc::detail
