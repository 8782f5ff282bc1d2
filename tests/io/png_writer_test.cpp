#include "pdc/io/png_writer.h"

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <stdexcept>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc {
namespace {

Image gradient() {
  Image image{5, 3, {}};
  for (int i = 0; i < 15; ++i)
    image.pixels.push_back({static_cast<std::uint8_t>(16 * i), static_cast<std::uint8_t>(255 - i), 7});
  return image;
}

TEST(PngWriter, ReadsBackAsItWas) {
  const Image image = gradient();
  const auto bytes = encodePng(image);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(png.width, 5u);
  EXPECT_EQ(png.height, 3u);
  png.format = PNG_FORMAT_RGB;
  auto pixels = image.pixels;
  std::fill(pixels.begin(), pixels.end(), std::array<std::uint8_t, 3>{});
  ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels, image.pixels);
}

TEST(PngWriter, WritesTheSameBytesToAFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  EXPECT_EQ(writePng(gradient(), path), encodePng(gradient()).size());
  EXPECT_EQ(std::filesystem::file_size(path), encodePng(gradient()).size());
}

TEST(PngWriter, Refusals) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(checkPngPath(folder.path() / "a.PNG"));
  EXPECT_THROW(checkPngPath(folder.path() / "a.jpg"), Error);
  EXPECT_THROW(checkPngPath(folder.path() / "none/a.png"), Error);
  EXPECT_THROW(static_cast<void>(encodePng({})), std::invalid_argument);
  Image wrong = gradient();
  wrong.pixels.pop_back();
  EXPECT_THROW(static_cast<void>(encodePng(wrong)), std::invalid_argument);
}

}  // namespace
}  // namespace pdc
