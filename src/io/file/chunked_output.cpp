#include "io/file/chunked_output.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "io/file/byte_output.h"

namespace pdc::detail {

void writeChunked(ByteOutput& file, std::size_t count, std::size_t itemsPerChunk, const FormatChunk& format) {
  const std::size_t chunks = (count + itemsPerChunk - 1) / itemsPerChunk;
  // The last stage takes chunks in order, so when chunk i + live starts chunk i is written and its buffer free.
  const auto live = 2 * static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
  std::vector<ChunkBuffer> buffers(std::min(live, chunks));

  std::size_t next = 0;
  const auto number =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
        if (next == chunks) flow.stop();
        return next++;
      });
  const auto fill = tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, [&](std::size_t i) {
    ChunkBuffer& buffer = buffers[i % buffers.size()];
    buffer.clear();
    format(i * itemsPerChunk, std::min(count, (i + 1) * itemsPerChunk), buffer);
    return i;
  });
  const auto write = tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [&](std::size_t i) {
    const ChunkBuffer& buffer = buffers[i % buffers.size()];
    file.write(buffer.data(), buffer.size());
  });
  if (chunks > 0) tbb::parallel_pipeline(live, number & fill & write);
}

}  // namespace pdc::detail
