#include "io/vdb/vdb_file.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>

#include "io/vdb/vdb_tree_check.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr char kNameSeparator = '\x1e';
constexpr std::uint32_t kOldestVersion = 222;  // OpenVDB 1.1; older ones laid trees out differently.
constexpr std::uint32_t kNewestVersion = 224;

/// The bytes that a map writes about itself, which are vectors and matrices of doubles.
std::optional<std::uint64_t> mapSize(std::string_view type) {
  constexpr std::uint64_t kVector = 3 * 8, kMatrix = 16 * 8, kScale = 5 * kVector;
  if (type == "UniformScaleMap" || type == "ScaleMap") return kScale;
  if (type == "UniformScaleTranslateMap" || type == "ScaleTranslateMap") return kVector + kScale;
  if (type == "TranslationMap") return kVector;
  if (type == "AffineMap" || type == "UnitaryMap") return kMatrix;
  return std::nullopt;
}

std::string lengthAndBytes(const std::string& text) {
  const auto length = static_cast<std::uint32_t>(text.size());
  return std::string(reinterpret_cast<const char*>(&length), sizeof(length)) + text;
}

std::string readMap(ByteReader& bytes) {
  constexpr std::uint64_t kFrustumBytes = 8 * 8;  // Box, taper and depth, before another map.
  std::string type = bytes.string();
  std::string result = lengthAndBytes(type);
  if (type == "NonlinearFrustumMap") {
    result += bytes.bytes(kFrustumBytes);
    type = bytes.string();
    result += lengthAndBytes(type);
  }
  const auto size = mapSize(type);
  if (!size) throw Error(fmt::format("transform \"{}\" is unknown", type));
  return result + bytes.bytes(*size);
}

}  // namespace

std::string VdbEntry::shownName() const {
  const std::size_t separator = uniqueName.find(kNameSeparator);
  if (separator == std::string::npos) return uniqueName;
  return fmt::format("{}[{}]", uniqueName.substr(0, separator), uniqueName.substr(separator + 1));
}

VdbFile::VdbFile(const std::filesystem::path& path) : mBytes(path) {
  readHeader();
  readMetadata();
  readEntries();
}

void VdbFile::readHeader() {
  constexpr std::int64_t kMagic = 0x56444220;
  constexpr std::uint64_t kUuidBytes = 36;
  if (mBytes.size() < sizeof(kMagic) || mBytes.get<std::int64_t>() != kMagic) throw Error("not a VDB file");
  mVersion = mBytes.get<std::uint32_t>();
  if (mVersion < kOldestVersion || mVersion > kNewestVersion)
    throw Error(
        fmt::format("VDB file version {}; versions {} to {} can be read", mVersion, kOldestVersion, kNewestVersion));
  mLibraryMajor = mBytes.get<std::uint32_t>();
  mLibraryMinor = mBytes.get<std::uint32_t>();
  mHasOffsets = mBytes.get<char>() != 0;
  mBytes.skip(kUuidBytes);
}

std::vector<VdbMetadata> VdbFile::readMetadata() {
  std::vector<VdbMetadata> all;
  for (auto count = mBytes.get<std::uint32_t>(); count > 0; --count) {
    VdbMetadata metadata;
    metadata.name = mBytes.string();
    metadata.type = mBytes.string();
    metadata.value = mBytes.string();
    all.push_back(std::move(metadata));
  }
  return all;
}

void VdbFile::readEntries() {
  constexpr std::string_view kHalfSuffix = "_HalfFloat";
  for (auto count = mBytes.get<std::int32_t>(); count > 0; --count) {
    VdbEntry entry;
    entry.uniqueName = mBytes.string();
    entry.type = mBytes.string();
    entry.half = entry.type.ends_with(kHalfSuffix);
    if (entry.half) entry.type.resize(entry.type.size() - kHalfSuffix.size());
    entry.parent = mBytes.string();
    const auto begin = mBytes.get<std::uint64_t>();
    mBytes.skip(sizeof(std::uint64_t));  // Where the buffers start, which nobody asks for.
    const auto end = mBytes.get<std::uint64_t>();
    if (mHasOffsets) {
      if (begin < mBytes.position() || begin > end || end > mBytes.size())
        throw Error(fmt::format("grid \"{}\" should be at bytes {} to {}, but the file has {}", entry.shownName(),
                                begin, end, mBytes.size()));
      entry.begin = begin;
      entry.end = end;
      mBytes.seek(end, mBytes.size());
    } else {
      // The file was written to a stream that cannot seek, so only walking through a grid tells where it ends.
      entry.begin = mBytes.position();
      entry.end = mBytes.size();
      const VdbGridHead head = readHead(entry);
      entry.end = entry.parent.empty() ? checkTree(entry, head) : head.tree;
      mBytes.seek(entry.end, mBytes.size());
    }
    mEntries.push_back(std::move(entry));
  }
}

VdbGridHead VdbFile::readHead(const VdbEntry& entry) {
  mBytes.seek(entry.begin, entry.end);
  VdbGridHead head;
  head.compression = mBytes.get<std::uint32_t>();
  head.metadata = readMetadata();
  head.transform = readMap(mBytes);
  head.tree = mBytes.position();
  // What a grid says of itself counts more than the table of contents, as in OpenVDB.
  head.half = entry.half;
  for (const VdbMetadata& metadata : head.metadata)
    if (metadata.name == "is_saved_as_half_float" && metadata.type == "bool" && metadata.value.size() == 1)
      head.half = metadata.value[0] != 0;
  return head;
}

std::uint64_t VdbFile::checkTree(const VdbEntry& entry, const VdbGridHead& head) {
  mBytes.seek(head.tree, entry.end);
  checkVdbTree(mBytes, {entry.type, head.compression, head.half});
  return mBytes.position();
}

}  // namespace pdc::detail
