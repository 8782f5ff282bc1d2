#include "io/volume/tiff_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/file_error.h"
#include "io/file/suffix.h"
#include "io/volume/child_stream.h"
#include "io/volume/header_text.h"
#include "io/volume/tiff_pages.h"
#include "pdc/error.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

bool isTiff(const fs::path& path) {
  const std::string suffix = suffixOf(path);
  return suffix == ".tif" || suffix == ".tiff";
}

/// Compares names such that numbers in them count by their values: s2 comes before s10.
bool comesBefore(const fs::path& a, const fs::path& b) {
  const std::string x = a.filename().string(), y = b.filename().string();
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < x.size() && j < y.size()) {
    if (!isDigit(x[i]) || !isDigit(y[j])) {
      if (x[i] != y[j]) return x[i] < y[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t begin = at;
      while (at < s.size() && isDigit(s[at])) ++at;
      return std::string_view(s).substr(begin, at - begin);
    };
    const std::string_view m = number(x, i), n = number(y, j);
    if (m.size() != n.size()) return m.size() < n.size();
    if (m != n) return m < n;
  }
  return x.size() - i != y.size() - j ? x.size() - i < y.size() - j : x < y;
}

std::vector<fs::path> filesOf(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path))
    if (isTiff(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end(), comesBefore);
  if (files.empty()) throw Error("the folder has no .tif files");
  return files;
}

/// What ImageJ says in a page's description, "key=value" line by line; the value of a key, or nothing.
std::string_view imageJ(std::string_view description, std::string_view key) {
  if (!description.starts_with("ImageJ=")) return {};
  TextScanner scanner(description, '\0');
  while (scanner.nextLine()) {
    const std::string_view line = trimmed(scanner.wholeLine());
    if (line.size() > key.size() && line.starts_with(key) && line[key.size()] == '=')
      return line.substr(key.size() + 1);
  }
  return {};
}

std::int64_t countOf(std::string_view description, std::string_view key) {
  return TextScanner::parse<std::int64_t>(imageJ(description, key)).value_or(1);
}

std::vector<MemoryAxis> axesOf(const TiffFacts& facts, std::string_view description, std::int64_t pages) {
  std::vector<MemoryAxis> axes;
  if (facts.samples > 1) axes.push_back({facts.samples, MemoryAxis::kChannel});
  axes.push_back({facts.width, 0});
  axes.push_back({facts.height, 1});
  const std::int64_t channels = countOf(description, "channels"), slices = countOf(description, "slices"),
                     frames = countOf(description, "frames");
  const bool says = channels > 0 && slices > 0 && frames > 0 && channels <= pages && slices <= pages &&
                    frames <= pages && channels * frames > 1 && channels * slices * frames == pages;
  if (!says) {
    axes.push_back({pages, 2});
    return axes;
  }
  if (channels > 1) axes.push_back({channels, MemoryAxis::kChannel});
  axes.push_back({slices, 2});
  if (frames > 1) axes.push_back({frames, MemoryAxis::kVolume});
  if (channels > 1 && facts.samples > 1)
    throw Error("has colours and channels, of which one at most can be chosen from");
  return axes;
}

/// ImageJ stores pixels per unit of x and y as the resolution, and spacing and unit in the description.
void place(const TiffFacts& facts, std::string_view description, DenseVolume& volume) {
  const auto spacing = TextScanner::parse<double>(imageJ(description, "spacing"));
  const bool known = description.starts_with("ImageJ=") && facts.xResolution > 0 && facts.yResolution > 0 &&
                     !imageJ(description, "unit").empty();
  if (!known) return noteNoSpacing(volume);
  const Vec3d steps =
      regularSpacing({1 / facts.xResolution, 1 / facts.yResolution, spacing.value_or(0)}, "ImageJ's spacing", volume);
  volume.linear = Mat3d::diagonal(steps.x, steps.y, steps.z);
  volume.orientation = "ImageJ";
  const std::string unit = oneLine(imageJ(description, "unit"));
  volume.unit = unit == "micron" || unit == "\\u00B5m" ? "um" : unit;
}

ScalarType typeOf(const TiffFacts& facts) {
  constexpr int kUnsigned = 1, kSigned = 2, kFloat = 3;
  if (facts.format == kFloat && facts.bits == 16) return ScalarType::kFloat16;
  if (facts.format == kFloat && facts.bits == 32) return ScalarType::kFloat32;
  if (facts.format == kFloat && facts.bits == 64) return ScalarType::kFloat64;
  const bool isSigned = facts.format == kSigned;
  if (isSigned || facts.format == kUnsigned) switch (facts.bits) {
      case 8:
        return isSigned ? ScalarType::kInt8 : ScalarType::kUint8;
      case 16:
        return isSigned ? ScalarType::kInt16 : ScalarType::kUint16;
      case 32:
        return isSigned ? ScalarType::kInt32 : ScalarType::kUint32;
      case 64:
        return isSigned ? ScalarType::kInt64 : ScalarType::kUint64;
      default:
        break;
    }
  throw Error(fmt::format("TIFF values of {} bits, format {}, are not read", facts.bits, facts.format));
}

}  // namespace

bool isTiffFolder(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return false;
  for (const auto& entry : fs::directory_iterator(path, ignored))
    if (isTiff(entry.path())) return true;
  return false;
}

VolumeHeader readTiffStack(const fs::path& path, const VolumeReadOptions& options, const Monitor& monitor) {
  const std::vector<fs::path> files = filesOf(path);
  ChildStream stream("reading TIFF", [&files](ChildOutput& out) { writeTiffPages(files, out); });
  TiffFacts facts;
  stream.read({reinterpret_cast<char*>(&facts), sizeof(facts)});
  facts.description.back() = '\0';
  const std::string_view description(facts.description.data());

  VolumeHeader header;
  DenseVolume& volume = header.volume;
  volume.format = "TIFF";
  volume.view.type = typeOf(facts);
  const std::int64_t images = countOf(description, "images");
  // ImageJ writes one page for all beyond 4 GB, and smaller files of others may have one, too.
  const bool single = files.size() == 1 && facts.pages == 1 && images > 1 && facts.rawOffset > 0;
  layOut(axesOf(facts, description, single ? images : facts.pages), options, header);
  place(facts, description, volume);
  if (single) {
    volume.view.swapped = facts.swapped != 0 && sizeOf(volume.view.type) > 1;
    header.data.pieces = {{files.front(), facts.rawOffset}};
    return header;
  }
  auto buffer = std::make_shared<Buffer<char>>(header.data.bytes);
  const std::uint64_t page = header.data.bytes / static_cast<std::uint64_t>(facts.pages);
  for (std::int64_t i = 0; i < facts.pages; ++i) {
    monitor.throwIfStopped();
    stream.read(std::span(*buffer).subspan(static_cast<std::uint64_t>(i) * page, page));
    if (monitor.progress) monitor.progress("reading", static_cast<double>(i + 1) / static_cast<double>(facts.pages));
  }
  header.loaded = {reinterpret_cast<const std::byte*>(buffer->data()), buffer};
  return header;
}

}  // namespace pdc::detail
