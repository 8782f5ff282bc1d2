#pragma once

#include <cstdint>

#include "io/file/byte_output.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {

/// Deflates what is written (RFC 1951), on all threads: in blocks that do not refer to each other, so that the bytes do
/// not depend on the number of threads.
class DeflateOutput final : public ByteOutput {
 public:
  /// \param to has to live as long.
  explicit DeflateOutput(ByteOutput& to) : mTo(to) {}

  void write(const void* data, std::size_t size) override;
  /// Ends the stream; nothing can be written afterwards.
  void finish() { deflateWaiting(true); }

  /// Of all that was written, once finished.
  [[nodiscard]] std::uint32_t crc32() const { return mCrc; }
  [[nodiscard]] std::uint64_t bytesIn() const { return mBytesIn; }
  [[nodiscard]] std::uint64_t bytesOut() const { return mBytesOut; }

 private:
  void deflateWaiting(bool last);

  ByteOutput& mTo;
  Buffer<char> mWaiting;
  std::uint32_t mCrc = 0;
  std::uint64_t mBytesIn = 0, mBytesOut = 0;
};

/// A gzip file (RFC 1952) of what is written, without a name or a time. finish() has to end it.
class GzipOutput final : public ByteOutput {
 public:
  /// \param to has to live as long.
  explicit GzipOutput(ByteOutput& to);

  void write(const void* data, std::size_t size) override { mDeflated.write(data, size); }
  void finish();

 private:
  ByteOutput& mTo;
  DeflateOutput mDeflated;
};

}  // namespace pdc::detail
