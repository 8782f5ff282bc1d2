#include "io/deflate/inflate.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

/// Between two looks at the monitor, and what zlib counts in 32 bits.
constexpr std::size_t kPiece = std::size_t{1} << 22;

/// zlib's own names of windows: the largest, with 32 for either header, negative for none.
constexpr int windowBits(DeflateWrapping wrapping) {
  return wrapping == DeflateWrapping::kNone ? -MAX_WBITS : MAX_WBITS + 32;
}

}  // namespace

struct InflateStream::State {
  z_stream stream{};
};

InflateStream::InflateStream(std::span<const char> bytes, DeflateWrapping wrapping)
    : mState(std::make_unique<State>()), mBytes(bytes), mWrapped(wrapping == DeflateWrapping::kGzipOrZlib) {
  if (inflateInit2(&mState->stream, windowBits(wrapping)) != Z_OK) throw std::bad_alloc();
}

InflateStream::~InflateStream() { inflateEnd(&mState->stream); }

/// Goes to the next of several gzip streams; what else follows the first is no part of the data.
void InflateStream::beginNext() {
  const auto is = [&](std::size_t i, unsigned char value) { return static_cast<unsigned char>(mBytes[i]) == value; };
  mEnded = !(mWrapped && mBytes.size() - mUsed > 2 && is(mUsed, 0x1f) && is(mUsed + 1, 0x8b));
  if (!mEnded) inflateReset(&mState->stream);
}

std::size_t InflateStream::readSome(void* to, std::size_t bytes) {
  z_stream& stream = mState->stream;
  std::size_t done = 0;
  while (done < bytes && !mEnded) {
    const std::size_t in = std::min(kPiece, mBytes.size() - mUsed), out = std::min(kPiece, bytes - done);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(mBytes.data() + mUsed));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = static_cast<Bytef*>(to) + done;
    stream.avail_out = static_cast<uInt>(out);
    const int result = inflate(&stream, Z_NO_FLUSH);
    mUsed += in - stream.avail_in;
    done += out - stream.avail_out;
    if (result == Z_STREAM_END)
      beginNext();
    else if (result == Z_BUF_ERROR || (result == Z_OK && stream.avail_out == out && stream.avail_in == in))
      throw Error("the compressed data ends early");
    else if (result != Z_OK)
      throw Error(fmt::format("the compressed data is damaged: {}", stream.msg == nullptr ? "zlib" : stream.msg));
  }
  return done;
}

void InflateStream::read(std::span<char> to, const Monitor& monitor) {
  for (std::size_t done = 0; done < to.size();) {
    monitor.throwIfStopped();
    const std::size_t size = std::min(kPiece, to.size() - done);
    if (const std::size_t got = readSome(to.data() + done, size); got < size)
      throw Error(fmt::format("the compressed data ends early: {} bytes of {} are there", done + got, to.size()));
    done += size;
    if (monitor.progress) monitor.progress("reading", share());
  }
}

void InflateStream::skip(std::uint64_t bytes, const Monitor& monitor) {
  std::array<char, std::size_t{1} << 16> passed;
  for (std::uint64_t left = bytes; left > 0;) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, passed.size()));
    read({passed.data(), size}, monitor);
    left -= size;
  }
}

double InflateStream::share() const {
  return mBytes.empty() ? 1.0 : static_cast<double>(mUsed) / static_cast<double>(mBytes.size());
}

Buffer<char> inflateAll(std::span<const char> bytes) {
  InflateStream stream(bytes);
  Buffer<char> inflated;
  for (;;) {
    const std::size_t size = inflated.size(), more = std::max(kPiece, size / 2);
    inflated.resize(size + more);
    const std::size_t got = stream.readSome(inflated.data() + size, more);
    if (got == more) continue;
    inflated.resize(size + got);
    return inflated;
  }
}

}  // namespace pdc::detail
