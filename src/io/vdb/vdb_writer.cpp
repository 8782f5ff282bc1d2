#include "pdc/io/vdb/vdb_writer.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/file/suffix.h"

namespace pdc {
namespace {

/// Where a file has its identification, as text, behind the magic number, three versions and a flag.
constexpr std::size_t kTagAt = 21, kTagSize = 36;

/// OpenVDB writes to any stream, but lets only its own files do so.
class Archive final : public openvdb::io::Archive {
 public:
  [[nodiscard]] openvdb::io::Archive::Ptr copy() const override { return std::make_shared<Archive>(*this); }
  void write(std::ostream& stream, const openvdb::GridCPtrVec& grids) const {
    openvdb::io::Archive::write(stream, grids, /*seekable=*/true);
  }
};

std::uint64_t hashOf(std::string_view text, std::uint64_t start) {
  for (const char c : text) start = (start ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  return start;
}

/// In the form of a UUID.
std::string tagOf(std::string_view content) {
  const std::uint64_t a = hashOf(content, 0xCBF29CE484222325), b = hashOf(content, 0x9E3779B97F4A7C15);
  return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", a >> 32, a >> 16 & 0xFFFF, a & 0xFFFF, b >> 48,
                     b & 0xFFFFFFFFFFFF);
}

}  // namespace

void checkVdbPath(const std::filesystem::path& path) {
  if (detail::suffixOf(path) != ".vdb") throw Error(fmt::format("'{}': the suffix must be .vdb", path.string()));
  detail::checkWritable(path);
}

std::size_t writeVdb(const openvdb::GridBase::ConstPtr& grid, const std::filesystem::path& path) {
  if (!grid) throw std::invalid_argument("writeVdb: the grid is null");
  checkVdbPath(path);
  openvdb::initialize();
  std::ostringstream stream(std::ios::binary);
  Archive().write(stream, {grid});
  const std::string_view content = stream.view();
  if (!stream || content.size() < kTagAt + kTagSize) throw detail::fileError(path, "the grid cannot be written");
  const std::string_view rest = content.substr(kTagAt + kTagSize);
  const std::string tag = tagOf(rest);
  detail::AtomicFile file(path);
  file.write(content.data(), kTagAt);
  file.write(tag.data(), tag.size());
  file.write(rest.data(), rest.size());
  file.commit();
  return file.bytesWritten();
}

}  // namespace pdc
