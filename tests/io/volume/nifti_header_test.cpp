#include <cmath>
#include <limits>

#include "io/volume/nifti_files.h"

namespace pdc {
namespace {

class NiftiHeader : public ::testing::Test {
 protected:
  DenseVolume read(const NiftiFile& file, const VolumeReadOptions& options = {}) const {
    write(file);
    return readVolume(mFolder / "a.nii", options);
  }
  void write(const NiftiFile& file) const {
    writeContents(mFolder / "a.nii", file.header() + rampBytes<std::int16_t>(file.bigEndian));
  }
  TemporaryFolder mFolder;
};

TEST_F(NiftiHeader, BothVersionsAndByteOrdersGiveTheSameValuesAndPlaces) {
  for (const bool second : {false, true})
    for (const bool bigEndian : {false, true}) {
      NiftiFile file;
      file.second = second;
      file.bigEndian = bigEndian;
      file.sformCode = 1;
      file.sform = {2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30};
      const DenseVolume volume = read(file);
      expectRamp<std::int16_t>(volume);
      expectNear(placeOf(volume, {1, 1, 1}), {12, 23, 34});
      EXPECT_EQ(volume.format, second ? "NIfTI-2" : "NIfTI-1");
      EXPECT_EQ(volume.space, "RAS");
      EXPECT_EQ(volume.unit, "mm");
      EXPECT_TRUE(volume.warnings.empty());
    }
}

TEST_F(NiftiHeader, GzipGivesWhatIsInIt) {
  NiftiFile file;
  file.sformCode = 1;
  file.sform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  writeContents(mFolder / "a.nii.gz", deflated(file.header() + rampBytes<std::int16_t>()));
  const DenseVolume volume = readVolume(mFolder / "a.nii.gz");
  expectRamp<std::int16_t>(volume);
  EXPECT_EQ(volume.encoding, "deflate");
}

TEST_F(NiftiHeader, PairsAreReadByEitherName) {
  NiftiFile file;
  file.pair = true;
  writeContents(mFolder / "a.hdr", file.header());
  writeContents(mFolder / "a.img", rampBytes<std::int16_t>());
  expectRamp<std::int16_t>(readVolume(mFolder / "a.hdr"));
  expectRamp<std::int16_t>(readVolume(mFolder / "a.img"));
}

TEST_F(NiftiHeader, SlopesOfZeroAndNanScaleNothing) {
  for (const double slope : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    NiftiFile file;
    file.slope = slope;
    file.intercept = 7;
    expectRamp<std::int16_t>(read(file));
  }
  NiftiFile file;
  file.slope = 0.5;
  file.intercept = -100;
  expectRamp<std::int16_t>(read(file), 0.5, -100);
}

TEST_F(NiftiHeader, TheQformCountsOnlyWhereItsCodeSaysSo) {
  NiftiFile file;
  file.qformCode = 0;
  file.sformCode = 2;
  file.quaternion = {0, 0, 1};
  file.sform = {2, 0, 0, 1, 0, 3, 0, 2, 0, 0, 4, 3};
  const DenseVolume volume = read(file);
  EXPECT_EQ(volume.orientation, "sform, code 2");
  expectNear(placeOf(volume, {1, 0, 0}), {3, 2, 3});
  EXPECT_TRUE(volume.warnings.empty());
}

TEST_F(NiftiHeader, TheSformCountsOnlyWhereItsCodeSaysSo) {
  NiftiFile file;
  file.qformCode = 1;
  file.pixdim = {-1, 2, 3, 4};
  file.quaternion = {0, 0, std::sqrt(0.5)};  // a quarter turn about z
  file.shift = {10, 20, 30};
  file.sform = {9, 0, 0, 9, 0, 9, 0, 9, 0, 0, 9, 9};
  const DenseVolume volume = read(file);
  EXPECT_EQ(volume.orientation, "qform, code 1");
  expectNear(placeOf(volume, {0, 0, 0}), {10, 20, 30});
  expectNear(placeOf(volume, {1, 0, 0}), {10, 22, 30});
  expectNear(placeOf(volume, {0, 1, 0}), {7, 20, 30});
  expectNear(placeOf(volume, {0, 0, 1}), {10, 20, 26});
  EXPECT_LT(volume.linear.determinant(), 0);
}

TEST_F(NiftiHeader, FormsThatDifferAreWarnedOf) {
  NiftiFile file;
  file.qformCode = file.sformCode = 1;
  file.sform = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0};
  EXPECT_TRUE(read(file).warnings.empty());
  file.shift = {0, 0, 1};
  const DenseVolume volume = read(file);
  EXPECT_TRUE(mentions(volume.warnings, "sform and qform differ, by up to 1;"));
  EXPECT_EQ(volume.orientation, "sform, code 1");
}

TEST_F(NiftiHeader, WithoutFormsThereIsSpacingAndAWarning) {
  const DenseVolume volume = read(NiftiFile{});
  expectNear(placeOf(volume, {1, 1, 1}), {2, 3, 4});
  EXPECT_EQ(volume.space, "");
  EXPECT_TRUE(mentions(volume.warnings, "neither sform nor qform"));
}

TEST_F(NiftiHeader, ShearedAndMirroredMapsAreTakenAsTheyAre) {
  NiftiFile file;
  file.sformCode = 1;
  file.sform = {-1, 0.3, 0, 5, 0, 1, 0.2, 6, 0, 0, 2, 7};
  const DenseVolume volume = read(file);
  expectNear(placeOf(volume, {1, 2, 3}), {4.6, 8.6, 13});
  EXPECT_TRUE(volume.warnings.empty());
}

TEST_F(NiftiHeader, ASingularSformGivesWayToTheQform) {
  NiftiFile file;
  file.qformCode = file.sformCode = 1;
  const DenseVolume volume = read(file);
  EXPECT_EQ(volume.orientation, "qform, code 1");
  EXPECT_TRUE(mentions(volume.warnings, "sform has code 1 but is no map"));
}

TEST_F(NiftiHeader, TheFirstOfSeveralVolumesIsTakenAndSaid) {
  NiftiFile file;
  file.dim = {kRampSize[0], kRampSize[1], kRampSize[2], 2};
  std::string second = rampBytes<std::int16_t>();
  for (std::size_t i = 0; i < second.size(); i += 2) second[i] = static_cast<char>(second[i] + 1);
  writeContents(mFolder / "a.nii", file.header() + rampBytes<std::int16_t>() + second);
  const DenseVolume volume = readVolume(mFolder / "a.nii");
  expectRamp<std::int16_t>(volume);
  EXPECT_TRUE(mentions(volume.warnings, "holds 2 volumes"));
  expectRamp<std::int16_t>(readVolume(mFolder / "a.nii", {.volumeIndex = 1}), 1, 1);
  EXPECT_NE(errorOfReading(mFolder / "a.nii", {.volumeIndex = 2}).find("no volume 2: it has 2"), std::string::npos);
  writeContents(mFolder / "b.nii.gz", deflated(file.header() + rampBytes<std::int16_t>() + second));
  expectRamp<std::int16_t>(readVolume(mFolder / "b.nii.gz", {.volumeIndex = 1}), 1, 1);
}

TEST_F(NiftiHeader, ColoursNeedAChoice) {
  NiftiFile file;
  file.datatype = 128;
  file.dim = {1, 1, 2};
  writeContents(mFolder / "a.nii", file.header() + "abcdef");
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("has 3 values a point; --channel takes one"), std::string::npos);
  const DenseVolume green = readVolume(mFolder / "a.nii", {.channel = 1});
  EXPECT_EQ(valueAt<std::uint8_t>(green.view, 0, 0, 0), 'b');
  EXPECT_EQ(valueAt<std::uint8_t>(green.view, 0, 0, 1), 'e');
}

TEST_F(NiftiHeader, BadFilesAreOneLine) {
  NiftiFile file;
  const std::string whole = file.header() + rampBytes<std::int16_t>();
  writeContents(mFolder / "a.nii", whole.substr(0, whole.size() - 1));
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("ends early: the values take 472 bytes, but only 471"),
            std::string::npos);
  writeContents(mFolder / "a.nii", whole.substr(0, 100));
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("not NIfTI"), std::string::npos);
  writeContents(mFolder / "a.nii", std::string(348, 'x'));
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("not NIfTI"), std::string::npos);
  file.datatype = 1792;
  write(file);
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("type 1792 are not read"), std::string::npos);
  file = {};
  file.dim = {30000, 30000, 30000};
  write(file);
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("ends early"), std::string::npos);
  writeContents(mFolder / "b.nii.gz", deflated(file.header() + rampBytes<std::int16_t>()));
  EXPECT_NE(errorOfReading(mFolder / "b.nii.gz").find("ends early"), std::string::npos);
  file.second = true;
  file.dim = {std::int64_t{1} << 40, std::int64_t{1} << 40, 2};
  write(file);
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("too large"), std::string::npos);
  file.dim = {5, -4, 3};
  write(file);
  EXPECT_NE(errorOfReading(mFolder / "a.nii").find("a size is -4"), std::string::npos);
}

}  // namespace
}  // namespace pdc
