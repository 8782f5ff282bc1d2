#include "pdc/io/volume/volume_reader.h"

#include <atomic>
#include <fstream>

#include "io/volume/volume_files.h"

namespace pdc {
namespace {

TEST(ParseRawVolume, SizesTypeOrderAndSkip) {
  const RawVolume raw = parseRawVolume("256x128x64:u16be:512");
  EXPECT_EQ(raw.size, (std::array<std::int64_t, 3>{256, 128, 64}));
  EXPECT_EQ(raw.type, ScalarType::kUint16);
  EXPECT_TRUE(raw.bigEndian);
  EXPECT_EQ(raw.skip, 512u);
  EXPECT_FALSE(parseRawVolume("1x1x1:f32").bigEndian);
  EXPECT_FALSE(parseRawVolume("1x1x1:f32le").bigEndian);
}

TEST(ParseRawVolume, OtherTextsAreRefused) {
  for (const char* text : {"", "1x1:u8", "1x1x1", "1x1x0:u8", "1x1x1:u7", "1x1x1:u8:-1", "1x1x1:u8:1:1", "axbxc:u8",
                           "1x1x99999999999999999999:u8"})
    EXPECT_THROW(static_cast<void>(parseRawVolume(text)), Error) << text;
}

TEST(ReadVolume, RawValuesMappedAndInflated) {
  const TemporaryFolder folder;
  const RawVolume raw{.size = kRampSize, .type = ScalarType::kFloat32, .bigEndian = true, .skip = 3};
  writeContents(folder / "a.raw", "abc" + rampBytes<float>(true));
  expectRamp<float>(readVolume(folder / "a.raw", {.raw = raw}));
  writeContents(folder / "a.raw.gz", deflated("abc" + rampBytes<float>(true)));
  expectRamp<float>(readVolume(folder / "a.raw.gz", {.raw = raw}));
  writeContents(folder / "a.dat", "abc" + rampBytes<float>(true));
  expectRamp<float>(readVolume(folder / "a.dat", {.raw = raw}));
  EXPECT_NE(errorOfReading(folder / "a.raw").find("--raw says what they are"), std::string::npos);
}

TEST(ReadVolume, InrimageValuesAndSpacing) {
  const TemporaryFolder folder;
  std::string header =
      "#INRIMAGE-4#{\nXDIM=5\nYDIM=4\nZDIM=3\nVDIM=1\nTYPE=signed fixed\nPIXSIZE=16 bits\nCPU=sun\n"
      "SCALE=2**-1\nVX=2\nVY=3\nVZ=4\n";
  header.resize(252, '\n');
  header += "##}\n";
  writeContents(folder / "a.inr", header + rampBytes<std::int16_t>(true));
  const DenseVolume volume = readVolume(folder / "a.inr");
  expectRamp<std::int16_t>(volume, 0.5);
  expectNear(placeOf(volume, {1, 1, 1}), {2, 3, 4});
  writeContents(folder / "a.inr.gz", deflated(header + rampBytes<std::int16_t>(true)));
  expectRamp<std::int16_t>(readVolume(folder / "a.inr.gz"), 0.5);
  writeContents(folder / "a.inr", header);
  EXPECT_NE(errorOfReading(folder / "a.inr").find("ends early"), std::string::npos);
}

TEST(ReadVolume, NamesInUpperCaseAreKnown) {
  for (const char* name :
       {"a.NII", "a.nii.GZ", "b.Nrrd", "c.NHDR", "d.mha", "e.mhd", "f.npy", "g.npz", "h.inr", "i.raw"})
    EXPECT_TRUE(isVolumeFile(name)) << name;
  for (const char* name : {"a.gz", "a.vdb", "a.ply.gz", "nii", "a.nii.bz2"}) EXPECT_FALSE(isVolumeFile(name)) << name;
}

TEST(ReadVolume, SpacingChangesLengthsAndKeepsDirections) {
  const TemporaryFolder folder;
  writeContents(folder / "a.mha",
                "NDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n"
                "Offset = 1 2 3\nElementSpacing = 9 9 9\nElementDataFile = LOCAL\n" +
                    rampBytes<std::int16_t>());
  const DenseVolume volume = readVolume(folder / "a.mha", {.spacing = {{2, 3, 4}}});
  expectNear(placeOf(volume, {1, 0, 0}), {1, 4, 3});
  expectNear(placeOf(volume, {0, 1, 0}), {-2, 2, 3});
  EXPECT_NE(errorOfReading(folder / "a.mha", {.spacing = {{2, 0, 4}}}).find("a spacing is 0"), std::string::npos);
}

TEST(ReadVolume, ManyInflatedBytesAreReadInPieces) {
  const TemporaryFolder folder;
  constexpr std::int64_t kSide = 256;
  std::string zeros(kSide * kSide * kSide, '\0');
  zeros.back() = 7;
  writeContents(folder / "a.raw.gz", deflated(zeros));
  const RawVolume raw{.size = {kSide, kSide, kSide}, .type = ScalarType::kUint8};
  const DenseVolume volume = readVolume(folder / "a.raw.gz", {.raw = raw});
  EXPECT_EQ(valueAt<std::uint8_t>(volume.view, kSide - 1, kSide - 1, kSide - 1), 7);
  EXPECT_EQ(valueAt<std::uint8_t>(volume.view, kSide - 2, kSide - 1, kSide - 1), 0);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(static_cast<void>(readVolume(folder / "a.raw.gz", {.raw = raw}, {.stop = &stop})), Cancelled);
}

TEST(ReadVolume, FewBytesCannotHoldMany) {
  const TemporaryFolder folder;
  writeContents(folder / "a.raw.gz", deflated("few"));
  const RawVolume raw{.size = {1 << 20, 1 << 20, 1 << 10}, .type = ScalarType::kUint8};
  EXPECT_NE(errorOfReading(folder / "a.raw.gz", {.raw = raw}).find("ends early"), std::string::npos);
}

}  // namespace
}  // namespace pdc
