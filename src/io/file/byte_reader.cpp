#include "io/file/byte_reader.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/file/read_file.h"
#include "pdc/error.h"

namespace pdc::detail {

ByteReader::ByteReader(const std::filesystem::path& path) : mDescriptor(openForReading(path)), mBuffer(1 << 17) {
  mSize = static_cast<std::uint64_t>(::lseek(mDescriptor, 0, SEEK_END));
  mEnd = mSize;
}

ByteReader::~ByteReader() { ::close(mDescriptor); }

void ByteReader::seek(std::uint64_t position, std::uint64_t end) {
  if (position > end || end > mSize)
    throw Error(fmt::format("bytes {} to {} are asked for, but the file has {}", position, end, mSize));
  mPosition = position;
  mEnd = end;
}

void ByteReader::require(std::uint64_t bytes) const {
  if (bytes > left())
    throw Error(
        fmt::format("ends early: {} bytes are needed at byte {}, but only {} are there", bytes, mPosition, left()));
}

void ByteReader::skip(std::uint64_t bytes) {
  require(bytes);
  mPosition += bytes;
}

void ByteReader::read(void* to, std::uint64_t bytes) {
  require(bytes);
  const std::uint64_t end = mPosition + bytes;
  for (char* next = static_cast<char*>(to); mPosition < end;) {
    if (mPosition < mBufferBegin || mPosition >= mBufferEnd) fill();
    const std::uint64_t n = std::min(end, mBufferEnd) - mPosition;
    std::memcpy(next, mBuffer.data() + (mPosition - mBufferBegin), n);
    next += n;
    mPosition += n;
  }
}

std::string ByteReader::bytes(std::uint64_t count) {
  require(count);
  std::string result(count, '\0');
  read(result.data(), count);
  return result;
}

std::string ByteReader::string() { return bytes(get<std::uint32_t>()); }

void ByteReader::fill() {
  ssize_t n;
  do {
    n = ::pread(mDescriptor, mBuffer.data(), mBuffer.size(), static_cast<off_t>(mPosition));
  } while (n < 0 && errno == EINTR);
  if (n <= 0) throw Error(fmt::format("cannot be read at byte {}", mPosition));
  mBufferBegin = mPosition;
  mBufferEnd = mPosition + static_cast<std::uint64_t>(n);
}

}  // namespace pdc::detail
