#include "study/view/packed_numbers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>

#include "io/deflate/deflate_output.h"
#include "io/file/byte_output.h"

namespace pdc::detail {
namespace {

class BytesInMemory final : public ByteOutput {
 public:
  void write(const void* data, std::size_t size) override {
    const auto* const begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
  }
  Buffer<std::uint8_t> bytes;
};

}  // namespace

Buffer<std::uint8_t> packNumbers(std::span<const std::uint32_t> numbers) {
  constexpr std::size_t kGrain = 65536;
  const std::size_t count = numbers.size();
  Buffer<std::uint8_t> planes(4 * count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::uint32_t step = numbers[i] - (i > 0 ? numbers[i - 1] : 0);
      const std::uint32_t sign = step >> 31;
      const std::uint32_t folded = step << 1 ^ (0U - sign);
      for (std::size_t byte = 0; byte < 4; ++byte)
        planes[byte * count + i] = static_cast<std::uint8_t>(folded >> 8 * byte);
    }
  });
  BytesInMemory packed;
  GzipOutput gzip(packed);
  gzip.write(planes.data(), planes.size());
  gzip.finish();
  return std::move(packed.bytes);
}

}  // namespace pdc::detail
