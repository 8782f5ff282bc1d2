#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "io/deflate/inflate.h"
#include "io/file/mapped_file.h"
#include "io/volume/header_text.h"
#include "io/volume/volume_header.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

// The zip format as PKWARE's APPNOTE.TXT has it; all numbers are little-endian.
constexpr bool kSwapped = std::endian::native != std::endian::little;
constexpr std::size_t kEndBytes = 22, kEntryBytes = 46, kLocalBytes = 30, kLocatorBytes = 20, kEnd64Bytes = 56;
constexpr std::uint32_t kEnd = 0x06054b50, kEntry = 0x02014b50, kLocal = 0x04034b50, kLocator = 0x07064b50,
                        kEnd64 = 0x06064b50;
constexpr std::uint32_t kSee64 = 0xffffffff;

/// A file in a zip file.
struct ZipEntry {
  std::string name;
  int method = 0;
  std::uint64_t compressed = 0, size = 0, local = 0;
};

std::uint64_t get16(std::string_view b, std::size_t at) { return numberAt<std::uint16_t>(b, at, kSwapped); }
std::uint64_t get32(std::string_view b, std::size_t at) { return numberAt<std::uint32_t>(b, at, kSwapped); }
std::uint64_t get64(std::string_view b, std::size_t at) { return numberAt<std::uint64_t>(b, at, kSwapped); }

/// \throws Error unless `count` bytes are there from `at` on.
void require(std::string_view bytes, std::uint64_t at, std::uint64_t count) {
  if (at > bytes.size() || count > bytes.size() - at) throw Error("the zip file is damaged: it points behind its end");
}

/// Where the list of entries is, and how many there are.
struct ZipList {
  std::uint64_t offset = 0, count = 0;
};

ZipList findList(std::string_view bytes) {
  constexpr std::size_t kMostComment = 65535;
  if (bytes.size() < kEndBytes) throw Error("not a zip file: it is too short");
  const std::size_t last = bytes.size() - kEndBytes, first = last > kMostComment ? last - kMostComment : 0;
  for (std::size_t at = last + 1; at-- > first;) {
    if (get32(bytes, at) != kEnd) continue;
    ZipList list{get32(bytes, at + 16), get16(bytes, at + 10)};
    if (at >= kLocatorBytes && get32(bytes, at - kLocatorBytes) == kLocator) {
      const std::uint64_t end = get64(bytes, at - kLocatorBytes + 8);
      require(bytes, end, kEnd64Bytes);
      if (get32(bytes, end) != kEnd64) throw Error("the zip file is damaged: its long end is not where it should be");
      list = {get64(bytes, end + 48), get64(bytes, end + 32)};
    }
    return list;
  }
  throw Error("not a zip file, or cut off: it has no list of entries");
}

/// Takes sizes and place from the extra field where 32 bits do not hold them.
void takeLong(std::string_view extra, ZipEntry& entry) {
  for (std::size_t at = 0; at + 4 <= extra.size();) {
    const std::uint64_t id = get16(extra, at), size = get16(extra, at + 2);
    if (size > extra.size() - at - 4) break;
    std::string_view field = extra.substr(at + 4, size);
    at += 4 + size;
    if (id != 1) continue;
    for (std::uint64_t* const value : {&entry.size, &entry.compressed, &entry.local}) {
      if (*value != kSee64 || field.size() < 8) continue;
      *value = get64(field, 0);
      field.remove_prefix(8);
    }
  }
}

std::vector<ZipEntry> listEntries(std::string_view bytes) {
  const ZipList list = findList(bytes);
  std::vector<ZipEntry> entries;
  std::uint64_t at = list.offset;
  for (std::uint64_t i = 0; i < list.count; ++i) {
    require(bytes, at, kEntryBytes);
    if (get32(bytes, at) != kEntry) throw Error("the zip file is damaged: an entry is not where it should be");
    const std::uint64_t name = get16(bytes, at + 28), extra = get16(bytes, at + 30), comment = get16(bytes, at + 32);
    require(bytes, at, kEntryBytes + name + extra + comment);
    if ((get16(bytes, at + 8) & 1) != 0) throw Error("the zip file is encrypted");
    ZipEntry entry{std::string(bytes.substr(at + kEntryBytes, name)), static_cast<int>(get16(bytes, at + 10)),
                   get32(bytes, at + 20), get32(bytes, at + 24), get32(bytes, at + 42)};
    takeLong(bytes.substr(at + kEntryBytes + name, extra), entry);
    entries.push_back(std::move(entry));
    at += kEntryBytes + name + extra + comment;
  }
  return entries;
}

/// Where an entry's bytes begin.
std::uint64_t contentOf(std::string_view bytes, const ZipEntry& entry) {
  require(bytes, entry.local, kLocalBytes);
  if (get32(bytes, entry.local) != kLocal) throw Error("the zip file is damaged: a file is not where it should be");
  const std::uint64_t begin =
      entry.local + kLocalBytes + get16(bytes, entry.local + 26) + get16(bytes, entry.local + 28);
  require(bytes, begin, entry.compressed);
  return begin;
}

VolumeHeader readEntry(const std::filesystem::path& path, std::string_view bytes, const ZipEntry& entry) {
  constexpr int kStored = 0, kDeflate = 8;
  constexpr std::size_t kMostHeader = std::size_t{1} << 16;
  if (entry.method != kStored && entry.method != kDeflate)
    throw Error(fmt::format("'{}' is compressed by method {}; 0 and 8 are read", oneLine(entry.name), entry.method));
  const std::uint64_t begin = contentOf(bytes, entry);
  const std::string_view content = bytes.substr(begin, entry.compressed);
  std::string inflated;
  if (entry.method == kDeflate) {
    inflated.resize(kMostHeader);
    InflateStream stream({content.data(), content.size()}, DeflateWrapping::kNone);
    inflated.resize(stream.readSome(inflated.data(), inflated.size()));
  }
  VolumeHeader header = parseNpyHeader(entry.method == kDeflate ? std::string_view(inflated) : content);
  header.volume.format = "npz";
  header.data.encoding = entry.method == kDeflate ? VolumeEncoding::kBareDeflated : VolumeEncoding::kRaw;
  header.data.pieces = {{path, begin, entry.compressed}};
  return header;
}

/// The array's name, as NumPy gives it.
std::string arrayName(const ZipEntry& entry) {
  constexpr std::string_view kSuffix = ".npy";
  const std::string_view name = entry.name;
  return oneLine(name.ends_with(kSuffix) ? name.substr(0, name.size() - kSuffix.size()) : name);
}

std::string namesOf(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  return text.empty() ? "none" : text;
}

}  // namespace

VolumeHeader readNpzHeader(const std::filesystem::path& path, const VolumeReadOptions& options) {
  const MappedFile file(path);
  const std::string_view bytes(file.bytes().data(), file.bytes().size());
  const std::vector<ZipEntry> entries = listEntries(bytes);
  std::vector<std::string> all, volumes;
  std::optional<VolumeHeader> found;
  for (const ZipEntry& entry : entries) {
    all.push_back(arrayName(entry));
    if (options.array) {
      if (all.back() == *options.array) return readEntry(path, bytes, entry);
      continue;
    }
    try {
      found = readEntry(path, bytes, entry);
      volumes.push_back(all.back());
    } catch (const Error&) {  // One that is no volume may stand beside one that is.
    }
  }
  if (options.array) throw Error(fmt::format("has no array '{}'; it has {}", oneLine(*options.array), namesOf(all)));
  if (volumes.size() > 1)
    throw Error(fmt::format("has several arrays of 3 dimensions, {}; --array takes one of them", namesOf(volumes)));
  if (!found) throw Error(fmt::format("has no array of 3 dimensions; it has {}", namesOf(all)));
  return *std::move(found);
}

}  // namespace pdc::detail
