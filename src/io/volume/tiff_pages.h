#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/volume/child_stream.h"

namespace pdc::detail {

/// What the pages of TIFF files have in common.
struct TiffFacts {
  std::int64_t width = 0, height = 0, pages = 0, samples = 0;  ///< `samples` values a pixel.
  std::int32_t bits = 0, format = 0;                           ///< Of a value; `format` as TIFF's SampleFormat.
  /// Where the values of a single page begin if they lie in the file as they are, one after the other; else 0.
  std::uint64_t rawOffset = 0;
  std::int32_t swapped = 0;                 ///< Whether those are in the other byte order than the machine's.
  double xResolution = 0, yResolution = 0;  ///< Pixels per unit; 0 if it is not said.
  std::array<char, 2048> description{};     ///< Of the first page; ends with a zero.
};

/// Writes TiffFacts, then the values of all pages, rows from the top, in the machine's byte order: all pages of a
/// single file, the first one of each of several. \throws Error for damaged files, for more values than they can hold,
/// for pages that differ, and where this build has no libtiff.
void writeTiffPages(const std::vector<std::filesystem::path>& files, ChildOutput& out);

}  // namespace pdc::detail
