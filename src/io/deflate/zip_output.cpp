#include "io/deflate/zip_output.h"

#include <fmt/format.h>

#include <limits>

#include "io/deflate/deflate_output.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

// APPNOTE.TXT of PKWARE, 4.3. All numbers are little-endian.
constexpr std::uint32_t kLocalHeader = 0x04034b50, kDescriptor = 0x08074b50, kDirectoryEntry = 0x02014b50,
                        kEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20, kSizesFollow = 1 << 3, kDeflated = 8;
constexpr std::uint16_t kDay = 1 << 5 | 1;  // The first of January 1980: the same bytes every day.

class Record {
 public:
  Record& u16(std::uint16_t v) { return put(v, 2); }
  Record& u32(std::uint32_t v) { return put(v, 4); }
  Record& text(const std::string& t) {
    mBytes += t;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return mBytes; }

 private:
  Record& put(std::uint32_t v, int bytes) {
    for (int i = 0; i < bytes; ++i) mBytes += static_cast<char>(v >> (8 * i) & 0xff);
    return *this;
  }
  std::string mBytes;
};

std::uint32_t small(std::uint64_t v) {
  if (v >= std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("{} bytes do not fit into a zip archive, which takes 4 GiB", v));
  return static_cast<std::uint32_t>(v);
}

}  // namespace

void ZipOutput::write(const std::string& bytes) {
  mTo.write(bytes.data(), bytes.size());
  mWritten += bytes.size();
}

void ZipOutput::add(const std::string& name, const std::function<void(ByteOutput&)>& fill) {
  const std::uint32_t begin = small(mWritten);
  Record header;
  header.u32(kLocalHeader).u16(kVersion).u16(kSizesFollow).u16(kDeflated).u16(0).u16(kDay);
  header.u32(0).u32(0).u32(0).u16(static_cast<std::uint16_t>(name.size())).u16(0).text(name);
  write(header.bytes());
  DeflateOutput deflated(mTo);
  fill(deflated);
  deflated.finish();
  mWritten += deflated.bytesOut();
  const Entry entry{name, begin, deflated.crc32(), small(deflated.bytesOut()), small(deflated.bytesIn())};
  write(Record().u32(kDescriptor).u32(entry.crc).u32(entry.deflated).u32(entry.size).bytes());
  mEntries.push_back(entry);
}

void ZipOutput::finish() {
  const std::uint32_t begin = small(mWritten);
  for (const Entry& e : mEntries) {
    Record record;
    record.u32(kDirectoryEntry).u16(kVersion).u16(kVersion).u16(kSizesFollow).u16(kDeflated).u16(0).u16(kDay);
    record.u32(e.crc).u32(e.deflated).u32(e.size).u16(static_cast<std::uint16_t>(e.name.size())).u16(0).u16(0);
    record.u16(0).u16(0).u32(0).u32(e.begin).text(e.name);
    write(record.bytes());
  }
  const auto count = static_cast<std::uint16_t>(mEntries.size());
  const std::uint32_t size = small(mWritten - begin);
  write(Record().u32(kEnd).u16(0).u16(0).u16(count).u16(count).u32(size).u32(begin).u16(0).bytes());
}

}  // namespace pdc::detail
