#pragma once

#include <cstddef>
#include <functional>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

class ByteOutput;

/// The bytes of one chunk. A buffer keeps its memory from chunk to chunk.
using ChunkBuffer = Buffer<char>;

/// Formats items [begin, end) to the (empty) buffer.
using FormatChunk = std::function<void(std::size_t begin, std::size_t end, ChunkBuffer& out)>;

/// Formats `count` items in parallel, `itemsPerChunk` at a time, and appends the chunks to the file in order. Only a
/// few chunks per thread are in memory at once, and the file's bytes do not depend on the number of threads. What
/// `format` or the file throws passes through.
void writeChunked(ByteOutput& file, std::size_t count, std::size_t itemsPerChunk, const FormatChunk& format);

}  // namespace pdc::detail
