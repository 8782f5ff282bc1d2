#include "io/volume/volume_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "io/file/file_error.h"
#include "io/deflate/inflate.h"
#include "io/file/mapped_file.h"
#include "io/file/text_scanner.h"
#include "pdc/error.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {
namespace {

Error endsEarly(std::uint64_t needed, std::uint64_t there) {
  return Error(fmt::format("ends early: the values take {} bytes, but only {} are there", needed, there));
}

/// The bytes of the file that belong to the piece, with values still encoded.
std::span<const char> bytesOf(const VolumePiece& piece, const VolumeData& data, std::span<const char> file) {
  std::uint64_t offset = piece.offset;
  const std::uint64_t values = data.bytes / data.pieces.size();
  if (piece.atEnd) {
    if (values > file.size()) throw endsEarly(values, file.size());
    offset = file.size() - values;
  }
  if (offset > file.size()) throw endsEarly(values, 0);
  const std::uint64_t rest = file.size() - offset;
  if (piece.length > rest) throw endsEarly(piece.length, rest);
  return file.subspan(offset, piece.length > 0 ? piece.length : rest);
}

template <typename Number>
void parseNumbers(std::string_view text, std::uint64_t skip, std::span<char> to) {
  TextScanner scanner(text, '\0');
  bool there = scanner.nextLine();
  const std::uint64_t count = to.size() / sizeof(Number);
  for (std::uint64_t i = 0; i < skip + count; ++i) {
    std::string_view word = scanner.word();
    while (word.empty()) {
      if (!(there = there && scanner.nextLine()))
        throw Error(fmt::format("ends early: {} values of {} are there", i, skip + count));
      word = scanner.word();
    }
    const auto number = TextScanner::parse<Number>(word);
    if (!number)
      throw Error(fmt::format("line {}: \"{}\" is no value", scanner.lineNumber(), oneLine(word.substr(0, 60))));
    if (i >= skip) std::memcpy(to.data() + (i - skip) * sizeof(Number), &*number, sizeof(Number));
  }
}

void parseText(ScalarType type, std::string_view text, std::uint64_t begin, std::span<char> to) {
  // Of each value there are a digit and, but for the last, a blank.
  const std::uint64_t values = (begin + to.size()) / sizeOf(type);
  if (values > text.size() / 2 + 1) throw Error(fmt::format("ends early: {} values are not there", values));
  const std::uint64_t skip = begin / sizeOf(type);
  switch (type) {
    case ScalarType::kBool:
    case ScalarType::kUint8:
      return parseNumbers<std::uint8_t>(text, skip, to);
    case ScalarType::kInt8:
      return parseNumbers<std::int8_t>(text, skip, to);
    case ScalarType::kInt16:
      return parseNumbers<std::int16_t>(text, skip, to);
    case ScalarType::kUint16:
      return parseNumbers<std::uint16_t>(text, skip, to);
    case ScalarType::kInt32:
      return parseNumbers<std::int32_t>(text, skip, to);
    case ScalarType::kUint32:
      return parseNumbers<std::uint32_t>(text, skip, to);
    case ScalarType::kInt64:
      return parseNumbers<std::int64_t>(text, skip, to);
    case ScalarType::kUint64:
      return parseNumbers<std::uint64_t>(text, skip, to);
    case ScalarType::kFloat32:
      return parseNumbers<float>(text, skip, to);
    case ScalarType::kFloat64:
      return parseNumbers<double>(text, skip, to);
    case ScalarType::kFloat16:
      break;
  }
  throw Error("half floats as text are not read");
}

/// Decodes bytes [begin, begin + to.size()) of a piece. \param in its bytes in the file.
void decode(const VolumeData& data, std::span<const char> in, std::uint64_t begin, std::span<char> to,
            const Monitor& monitor) {
  switch (data.encoding) {
    case VolumeEncoding::kRaw:
      if (begin > in.size() || to.size() > in.size() - begin) throw endsEarly(begin + to.size(), in.size());
      std::memcpy(to.data(), in.data() + begin, to.size());
      return;
    case VolumeEncoding::kText:
      parseText(data.type, {in.data(), in.size()}, begin, to);
      return;
    case VolumeEncoding::kDeflated:
    case VolumeEncoding::kBareDeflated:
      break;
  }
  InflateStream stream(
      in, data.encoding == VolumeEncoding::kDeflated ? DeflateWrapping::kGzipOrZlib : DeflateWrapping::kNone);
  stream.skip(begin, monitor);
  stream.read(to, monitor);
}

/// Whether so many bytes can come out of so many at all.
void checkHolds(VolumeEncoding encoding, std::uint64_t in, std::uint64_t out) {
  const bool holds = encoding == VolumeEncoding::kRaw ? out <= in : canInflateTo(in, out);
  if (!holds) throw endsEarly(out, in);
}

/// Calls work() and puts the file's name before what it complains of, unless that is the header.
template <typename Work>
auto naming(const std::filesystem::path& path, const std::filesystem::path& header, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (path == header) throw;
    throw fileError(path, error.what());
  }
}

}  // namespace

LoadedBytes loadVolume(const VolumeData& data, std::uint64_t begin, std::uint64_t count,
                       const std::filesystem::path& header, const Monitor& monitor) {
  if (data.pieces.size() == 1 && data.encoding == VolumeEncoding::kRaw) {
    const VolumePiece& piece = data.pieces.front();
    return naming(piece.path, header, [&]() -> LoadedBytes {
      const auto file = std::make_shared<const MappedFile>(piece.path);
      const std::span<const char> in = bytesOf(piece, data, file->bytes());
      const std::uint64_t from = begin + data.skip;
      if (from > in.size() || count > in.size() - from) throw endsEarly(from + count, in.size());
      return {reinterpret_cast<const std::byte*>(in.data() + from), file};
    });
  }
  const std::uint64_t pieceBytes = data.bytes / data.pieces.size();
  const auto end = begin + count;
  auto buffer = std::make_shared<Buffer<char>>();
  for (std::size_t i = 0; i < data.pieces.size(); ++i) {
    const std::uint64_t first = i * pieceBytes, from = std::max(begin, first), to = std::min(end, first + pieceBytes);
    if (from >= to) continue;
    monitor.throwIfStopped();
    const VolumePiece& piece = data.pieces[i];
    naming(piece.path, header, [&] {
      const MappedFile file(piece.path);
      const std::span<const char> in = bytesOf(piece, data, file.bytes());
      checkHolds(data.encoding, in.size(), to - from);
      // Only now is this file known to be able to fill its part of the buffer.
      const std::size_t before = buffer->size();
      buffer->resize(before + (to - from));
      decode(data, in, from - first + data.skip, std::span(*buffer).subspan(before), monitor);
    });
    if (monitor.progress && data.pieces.size() > 1)
      monitor.progress("reading", static_cast<double>(i + 1) / static_cast<double>(data.pieces.size()));
  }
  return {reinterpret_cast<const std::byte*>(buffer->data()), buffer};
}

}  // namespace pdc::detail
