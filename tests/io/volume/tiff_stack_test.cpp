#include <atomic>
#include <cstdlib>

#include "io/volume/child_stream.h"
#include "io/volume/tiff_files.h"

namespace pdc {
namespace {

std::string slice(const std::string& values, std::size_t z) {
  const std::size_t size = values.size() / 3;
  return values.substr(z * size, size);
}

std::string stack(bool bigEndian, const std::string& description = "", int resolution = 0) {
  TiffPages pages(bigEndian, 16);
  for (std::size_t z = 0; z < 3; ++z)
    pages.add(5, 4, slice(rampBytes<std::uint16_t>(bigEndian), z), z == 0 ? description : "", resolution);
  return pages.bytes();
}

class TiffStack : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& content, const char* name = "a.tif") const {
    writeContents(mFolder / name, content);
    return mFolder / name;
  }
  TemporaryFolder mFolder;
};

TEST_F(TiffStack, PagesOfBothByteOrders) {
  for (const bool bigEndian : {false, true}) {
    const DenseVolume volume = readVolume(write(stack(bigEndian)));
    expectRamp<std::uint16_t>(volume);
    EXPECT_TRUE(mentions(volume.warnings, "says nothing of spacing"));
  }
}

TEST_F(TiffStack, FoldersInTheOrderOfNumbers) {
  std::filesystem::create_directory(mFolder / "slices");
  constexpr std::array<const char*, 3> kNames{"s2.tif", "s10.tif", "s100.TIF"};
  for (std::size_t z = 0; z < 3; ++z) {
    TiffPages page(false, 16);
    page.add(5, 4, slice(rampBytes<std::uint16_t>(), z));
    writeContents(mFolder / "slices" / kNames[z], page.bytes());
  }
  EXPECT_TRUE(isVolumeFile(mFolder / "slices"));
  expectRamp<std::uint16_t>(readVolume(mFolder / "slices"));
  TiffPages other(false, 16);
  other.add(4, 4, std::string(32, '\0'));
  writeContents(mFolder / "slices" / "s11.tif", other.bytes());
  EXPECT_NE(errorOfReading(mFolder / "slices").find("TIFF pages differ"), std::string::npos);
  EXPECT_FALSE(isVolumeFile(mFolder.path()));
}

TEST_F(TiffStack, ImageJsSpacingIsInTheDescription) {
  const DenseVolume volume =
      readVolume(write(stack(true, "ImageJ=1.53t\nimages=3\nslices=3\nunit=micron\nspacing=2.5\n", 4)));
  expectNear(placeOf(volume, {1, 1, 1}), {0.25, 0.25, 2.5});
  EXPECT_EQ(volume.unit, "um");
  EXPECT_TRUE(volume.warnings.empty());
}

TEST_F(TiffStack, ChannelsAndTimesAreChosen) {
  const auto channels = write(stack(false, "ImageJ=1.53t\nimages=3\nchannels=3\n"));
  EXPECT_NE(errorOfReading(channels).find("has 3 values a point"), std::string::npos);
  const DenseVolume third = readVolume(channels, {.channel = 2});
  EXPECT_EQ(third.view.size, (std::array<std::int64_t, 3>{5, 4, 1}));
  EXPECT_EQ(valueAt<std::uint16_t>(third.view, 1, 0, 0), rampAt(1, 0, 2));
  const DenseVolume first = readVolume(write(stack(false, "ImageJ=1.53t\nimages=3\nframes=3\n")));
  EXPECT_TRUE(mentions(first.warnings, "holds 3 volumes"));
}

TEST_F(TiffStack, OnePageForAllImagesIsMapped) {
  TiffPages pages(true, 16);
  pages.add(5, 4, rampBytes<std::uint16_t>(true), "ImageJ=1.53t\nimages=3\nslices=3\n");
  const DenseVolume volume = readVolume(write(pages.bytes()));
  expectRamp<std::uint16_t>(volume);
  EXPECT_EQ(volume.encoding, "raw");
}

TEST_F(TiffStack, DamagedFilesAreOneLine) {
  const std::string whole = stack(false);
  EXPECT_NE(errorOfReading(write(whole.substr(0, whole.size() - 10))), "");
  EXPECT_NE(errorOfReading(write("II*\0")), "");
  EXPECT_NE(errorOfReading(write("no picture")).find("a.tif"), std::string::npos);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(static_cast<void>(readVolume(write(whole), {}, {.stop = &stop})), Cancelled);
}

TEST_F(TiffStack, FewBytesCannotHoldLargePages) {
  TiffPages pages(false, 16);
  pages.add(std::int64_t{1} << 20, std::int64_t{1} << 16, "few");
  const std::string error = errorOfReading(write(pages.bytes()));
  EXPECT_NE(error.find("ends early: the values take 137438953472 bytes"), std::string::npos) << error;
}

TEST(ChildStream, CrashesAndErrorsOfTheChildAreErrorsHere) {
  std::string bytes(3, '\0');
  const auto errorOf = [&](const std::function<void(detail::ChildOutput&)>& work) -> std::string {
    try {
      detail::ChildStream("the work", work).read(bytes);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(errorOf([](detail::ChildOutput& out) { out.write("abc", 3); }), "");
  EXPECT_EQ(bytes, "abc");
  EXPECT_EQ(errorOf([](detail::ChildOutput& out) { out.write("ab", 2); }), "the work ended early");
  EXPECT_EQ(errorOf([](detail::ChildOutput&) { std::abort(); }), "the work crashed, signal 6");
  EXPECT_EQ(errorOf([](detail::ChildOutput&) { throw Error("no\nway"); }), "no way");
}

}  // namespace
}  // namespace pdc
