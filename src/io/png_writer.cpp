#include "pdc/io/png_writer.h"

#include <fmt/format.h>
#include <png.h>

#include <cstddef>
#include <stdexcept>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/file/suffix.h"

namespace pdc {
std::vector<std::uint8_t> encodePng(const Image& image) {
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.pixels.size() != width * height)
    throw std::invalid_argument(
        fmt::format("encodePng: {} pixels for {} x {}", image.pixels.size(), image.width, image.height));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_RGB;
  // The first call only counts.
  std::vector<std::uint8_t> bytes;
  png_alloc_size_t size = 0;
  for (int call = 0; call < 2; ++call) {
    bytes.resize(size);
    if (png_image_write_to_memory(&png, call == 0 ? nullptr : bytes.data(), &size, 0, image.pixels.data(), 0,
                                  nullptr) == 0)
      throw Error(fmt::format("cannot make a PNG: {}", png.message));
  }
  return bytes;
}

void checkPngPath(const std::filesystem::path& path) {
  if (detail::suffixOf(path) != ".png") throw detail::fileError(path, "a picture's suffix must be .png");
  detail::checkWritable(path);
}

std::size_t writePng(const Image& image, const std::filesystem::path& path) {
  checkPngPath(path);
  const std::vector<std::uint8_t> bytes = encodePng(image);
  detail::AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
  return file.bytesWritten();
}

}  // namespace pdc
