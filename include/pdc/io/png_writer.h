#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "pdc/render/image.h"

namespace pdc {

/// A picture as the bytes of a PNG file: RGB, eight bits, sRGB. The same picture gives the same bytes.
/// \throws std::invalid_argument if the picture has no pixels or not as many as its size says.
[[nodiscard]] std::vector<std::uint8_t> encodePng(const Image& image);

/// Checks that writePng() could write there, and makes no file. \throws Error unless `path` ends in .png, in any case, and lies in a
/// folder that exists and can be written to.
void checkPngPath(const std::filesystem::path& path);

/// Writes a .png file, which appears under its name only when it is complete. \returns the number of bytes written.
/// \throws what checkPngPath() and encodePng() throw, and Error if writing fails.
std::size_t writePng(const Image& image, const std::filesystem::path& path);

}  // namespace pdc
