#include "io/volume/tiff_pages.h"

#include "pdc/error.h"

#ifdef PDC_WITH_TIFF

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "io/file/file_error.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {
namespace {

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

/// The first thing that libtiff complained of. The process is a child of its own, which has one thread.
std::string& complaint() {
  static std::string text;
  return text;
}

void takeComplaint(const char* /*module*/, const char* format, va_list arguments) {
  if (!complaint().empty()) return;
  std::array<char, 500> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  complaint() = text.data();
}

Error damaged(const std::filesystem::path& path, const std::string& otherwise) {
  return fileError(path.filename(), complaint().empty() ? otherwise : complaint());
}

Tiff open(const std::filesystem::path& path) {
  Tiff tiff(TIFFOpen(path.c_str(), "r"), &TIFFClose);
  if (!tiff) throw damaged(path, "not TIFF");
  return tiff;
}

template <typename Number>
Number field(TIFF* tiff, std::uint32_t tag, Number otherwise) {
  Number value{};
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

/// Facts of the present page alone.
TiffFacts factsOf(TIFF* tiff) {
  TiffFacts facts;
  facts.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  facts.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  facts.samples = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  facts.bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  facts.format = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  if (facts.samples > 1 && field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, 1) != PLANARCONFIG_CONTIG)
    throw Error("TIFF pages whose colours lie apart are not read");
  if (facts.bits % 8 != 0 || facts.bits == 0 || facts.bits > 64)
    throw Error(fmt::format("TIFF values of {} bits are not read", facts.bits));
  constexpr std::int64_t kMostBytes = std::int64_t{1} << 40;
  if (facts.width < 1 || facts.height < 1 || facts.width * facts.samples > kMostBytes / facts.height / 8)
    throw Error(fmt::format("a page of {} x {} values is not read", facts.width, facts.height));
  return facts;
}

/// \throws Error if the pages have more values than the files can hold: before memory is taken for one.
void checkHolds(const std::vector<std::filesystem::path>& files, const TiffFacts& facts) {
  constexpr double kMostRatio = 4096;  // None of TIFF's codecs makes more of a byte.
  double there = 0;
  for (const std::filesystem::path& file : files) there += static_cast<double>(std::filesystem::file_size(file));
  const double values =
      static_cast<double>(facts.width * facts.samples) * static_cast<double>(facts.height * facts.pages);
  const double bytes = values * static_cast<double>(facts.bits) / 8;
  if (bytes > kMostRatio * there)
    throw Error(fmt::format("ends early: the values take {:.0f} bytes, but only {:.0f} are there", bytes, there));
}

void addDetails(TIFF* tiff, TiffFacts& facts) {
  facts.xResolution = static_cast<double>(field<float>(tiff, TIFFTAG_XRESOLUTION, 0));
  facts.yResolution = static_cast<double>(field<float>(tiff, TIFFTAG_YRESOLUTION, 0));
  const char* text = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr)
    std::strncpy(facts.description.data(), text, facts.description.size() - 1);
  facts.swapped = TIFFIsByteSwapped(tiff) != 0 ? 1 : 0;
  if (TIFFIsTiled(tiff) == 0 && field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, 1) == COMPRESSION_NONE)
    facts.rawOffset = TIFFGetStrileOffset(tiff, 0);
}

void readStrips(TIFF* tiff, std::size_t rowBytes, std::int64_t height, Buffer<char>& page) {
  const auto rows = static_cast<std::int64_t>(field<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP, 0));
  if (rows < 1) throw Error("a TIFF page has strips of no rows");
  for (std::int64_t row = 0, strip = 0; row < height; row += rows, ++strip) {
    const std::size_t bytes = static_cast<std::size_t>(std::min(rows, height - row)) * rowBytes;
    const tmsize_t got =
        TIFFReadEncodedStrip(tiff, static_cast<std::uint32_t>(strip),
                             page.data() + static_cast<std::size_t>(row) * rowBytes, static_cast<tmsize_t>(bytes));
    if (got != static_cast<tmsize_t>(bytes)) throw Error(complaint().empty() ? "a TIFF page ends early" : complaint());
  }
}

void readTiles(TIFF* tiff, const TiffFacts& facts, std::size_t pixelBytes, Buffer<char>& page) {
  const std::int64_t width = field<std::uint32_t>(tiff, TIFFTAG_TILEWIDTH, 0),
                     height = field<std::uint32_t>(tiff, TIFFTAG_TILELENGTH, 0);
  const tmsize_t size = TIFFTileSize(tiff);
  if (width < 1 || height < 1 || size < static_cast<tmsize_t>(pixelBytes) * width * height)
    throw Error("a TIFF page has tiles of no size");
  Buffer<char> tile(static_cast<std::size_t>(size));
  for (std::int64_t y = 0; y < facts.height; y += height)
    for (std::int64_t x = 0; x < facts.width; x += width) {
      if (TIFFReadTile(tiff, tile.data(), static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0) < 0)
        throw Error(complaint().empty() ? "a TIFF page ends early" : complaint());
      const auto columns = static_cast<std::size_t>(std::min(width, facts.width - x));
      for (std::int64_t row = 0; row < std::min(height, facts.height - y); ++row)
        std::memcpy(page.data() + static_cast<std::size_t>((y + row) * facts.width + x) * pixelBytes,
                    tile.data() + static_cast<std::size_t>(row * width) * pixelBytes, columns * pixelBytes);
    }
}

void writePage(TIFF* tiff, const TiffFacts& common, ChildOutput& out, Buffer<char>& page) {
  const TiffFacts facts = factsOf(tiff);
  if (facts.width != common.width || facts.height != common.height || facts.samples != common.samples ||
      facts.bits != common.bits || facts.format != common.format)
    throw Error(fmt::format("TIFF pages differ: {} x {} values of {} bits, and {} x {} of {}", common.width,
                            common.height, common.bits, facts.width, facts.height, facts.bits));
  const auto pixelBytes = static_cast<std::size_t>(facts.samples * facts.bits / 8);
  const std::size_t rowBytes = pixelBytes * static_cast<std::size_t>(facts.width);
  page.resize(rowBytes * static_cast<std::size_t>(facts.height));
  if (TIFFIsTiled(tiff) != 0)
    readTiles(tiff, facts, pixelBytes, page);
  else
    readStrips(tiff, rowBytes, facts.height, page);
  out.write(page.data(), page.size());
}

}  // namespace

void writeTiffPages(const std::vector<std::filesystem::path>& files, ChildOutput& out) {
  TIFFSetErrorHandler(takeComplaint);
  TIFFSetWarningHandler(nullptr);
  Tiff first = open(files.front());
  TiffFacts facts = factsOf(first.get());
  addDetails(first.get(), facts);
  facts.pages = static_cast<std::int64_t>(files.size());
  if (files.size() == 1) {
    facts.pages = 1;
    while (TIFFReadDirectory(first.get()) == 1) ++facts.pages;
    if (!complaint().empty()) throw damaged(files.front(), "damaged");
    if (TIFFSetDirectory(first.get(), 0) != 1) throw damaged(files.front(), "damaged");
  }
  checkHolds(files, facts);
  out.write(&facts, sizeof(facts));
  Buffer<char> page;
  if (files.size() == 1) {
    for (std::int64_t i = 0; i < facts.pages; ++i) {
      if (i > 0 && TIFFReadDirectory(first.get()) != 1) throw damaged(files.front(), "ends early");
      writePage(first.get(), facts, out, page);
    }
    return;
  }
  for (const std::filesystem::path& file : files) writePage(open(file).get(), facts, out, page);
}

}  // namespace pdc::detail

#else

namespace pdc::detail {

void writeTiffPages(const std::vector<std::filesystem::path>& /*files*/, ChildOutput& /*out*/) {
  throw Error("TIFF is not read: this pdc was built without libtiff");
}

}  // namespace pdc::detail

#endif
