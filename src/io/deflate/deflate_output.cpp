#include "io/deflate/deflate_output.h"

#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <vector>

namespace pdc::detail {
namespace {

/// Blocks this large are deflated to within a percent of what they are together.
constexpr std::size_t kBlock = std::size_t{1} << 18;
/// What waits at most before it is deflated.
constexpr std::size_t kWaiting = 64 * kBlock;

/// One block, to a whole number of bytes. \param last whether the stream ends with it.
Buffer<char> deflated(const char* bytes, std::size_t size, bool last) {
  z_stream stream{};
  constexpr int kWithoutHeader = -15, kMemory = 8;
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWithoutHeader, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  constexpr std::size_t kMark = 16;  // Of the end of a block that is not the last.
  Buffer<char> out(::deflateBound(&stream, static_cast<uLong>(size)) + kMark);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes));
  stream.avail_in = static_cast<uInt>(size);
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  ::deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
  out.resize(stream.total_out);
  ::deflateEnd(&stream);
  return out;
}

std::uint32_t crcOf(const char* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes), size));
}

}  // namespace

void DeflateOutput::write(const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const std::size_t part = std::min(size, kWaiting - mWaiting.size());
    mWaiting.insert(mWaiting.end(), next, next + part);
    next += part;
    size -= part;
    if (mWaiting.size() == kWaiting) deflateWaiting(false);
  }
}

void DeflateOutput::deflateWaiting(bool last) {
  const std::size_t blocks = std::max<std::size_t>(last ? 1 : 0, (mWaiting.size() + kBlock - 1) / kBlock);
  std::vector<Buffer<char>> out(blocks);
  std::vector<std::uint32_t> crcs(blocks);
  const auto sizeOf = [&](std::size_t i) { return std::min(kBlock, mWaiting.size() - i * kBlock); };
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    const char* const bytes = mWaiting.data() + i * kBlock;
    out[i] = deflated(bytes, sizeOf(i), last && i + 1 == blocks);
    crcs[i] = crcOf(bytes, sizeOf(i));
  });
  for (std::size_t i = 0; i < blocks; ++i) {
    mTo.write(out[i].data(), out[i].size());
    mBytesOut += out[i].size();
    mBytesIn += sizeOf(i);
    mCrc = static_cast<std::uint32_t>(::crc32_combine(mCrc, crcs[i], static_cast<z_off_t>(sizeOf(i))));
  }
  mWaiting.clear();
}

GzipOutput::GzipOutput(ByteOutput& to) : mTo(to), mDeflated(to) {
  constexpr unsigned char kUnknownSystem = 255;
  constexpr std::array<unsigned char, 10> kHeader{0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, kUnknownSystem};
  mTo.write(kHeader.data(), kHeader.size());
}

void GzipOutput::finish() {
  mDeflated.finish();
  const std::array<std::uint32_t, 2> trailer{mDeflated.crc32(), static_cast<std::uint32_t>(mDeflated.bytesIn())};
  mTo.write(trailer.data(), sizeof(trailer));
}

}  // namespace pdc::detail
