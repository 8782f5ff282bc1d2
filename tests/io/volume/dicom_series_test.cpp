#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "io/volume/dicom_files.h"

namespace pdc {
namespace {

/// Columns count up along x, rows along −z; the normal is y.
constexpr const char* kOrientation = "1\\0\\0\\0\\0\\-1";
const Vec3d kFirst{-10, 20, 30};

/// What a file of the ramp says; each holds one slice, or all.
struct Slice {
  int z = 0;
  double y = kFirst.y;  ///< Where it lies along the normal.
  int instance = 1;
  std::string series = "1.2.3";
  std::string slope = "2", intercept = "-1000";
  int storedBits = 16;
  int frames = 0;  ///< Above 0: a file with that many.
  bool placed = true;
};

std::string fileOf(const Slice& slice) {
  DicomFile file;
  file.text(0x0008, 0x0016, "UI", std::string("1.2.840.10008.5.1.4.1.1.2\0", 26));
  file.text(0x0008, 0x0060, "CS", "CT");
  file.text(0x0018, 0x0050, "DS", "9");
  file.text(0x0020, 0x000e, "UI", slice.series);
  file.text(0x0020, 0x0011, "IS", "7");
  file.text(0x0020, 0x0013, "IS", std::to_string(slice.instance));
  if (slice.placed) {
    file.text(0x0020, 0x0032, "DS", fmt::format("{}\\{}\\{}", kFirst.x, slice.y, kFirst.z));
    file.text(0x0020, 0x0037, "DS", kOrientation);
  }
  file.number(0x0028, 0x0002, 1);
  file.text(0x0028, 0x0004, "CS", "MONOCHROME2");
  if (slice.frames > 0) file.text(0x0028, 0x0008, "IS", std::to_string(slice.frames));
  file.number(0x0028, 0x0010, static_cast<int>(kRampSize[1]));
  file.number(0x0028, 0x0011, static_cast<int>(kRampSize[0]));
  file.text(0x0028, 0x0030, "DS", "0.5\\0.25");
  file.number(0x0028, 0x0100, 16);
  file.number(0x0028, 0x0101, slice.storedBits);
  file.number(0x0028, 0x0102, slice.storedBits - 1);
  file.number(0x0028, 0x0103, 1);
  file.text(0x0028, 0x1052, "DS", slice.intercept);
  file.text(0x0028, 0x1053, "DS", slice.slope);
  const std::string ramp = rampBytes<std::int16_t>();
  const std::size_t size = ramp.size() / static_cast<std::size_t>(kRampSize[2]);
  file.pixels(slice.frames > 0 ? ramp : ramp.substr(static_cast<std::size_t>(slice.z) * size, size));
  return file.bytes();
}

class DicomSeries : public ::testing::Test {
 protected:
  DicomSeries() { std::filesystem::create_directory(folder()); }
  [[nodiscard]] std::filesystem::path folder() const { return mFolder / "series"; }
  void add(const std::string& name, const Slice& slice) const { writeContents(folder() / name, fileOf(slice)); }
  /// Slices whose names and numbers do not follow their places.
  void addRamp(double lastY = kFirst.y + 3) const {
    add("b", {.z = 0, .instance = 2});
    add("c", {.z = 1, .y = kFirst.y + 1.5, .instance = 3});
    add("a", {.z = 2, .y = lastY, .instance = 1});
    writeContents(folder() / "README", "not DICOM");
  }

  TemporaryFolder mFolder;
};

TEST_F(DicomSeries, SlicesAreInTheOrderOfTheirPositions) {
  addRamp();
  EXPECT_TRUE(isVolumeFile(folder()));
  const DenseVolume volume = readVolume(folder());
  expectRamp<std::int16_t>(volume, 2, -1000);
  expectNear(placeOf(volume, {0, 0, 0}), kFirst);
  expectNear(placeOf(volume, {4, 3, 2}), kFirst + Vec3d{4 * 0.25, 2 * 1.5, -3 * 0.5});
  EXPECT_EQ(volume.format, "DICOM");
  EXPECT_EQ(volume.space, "LPS");
  EXPECT_EQ(volume.unit, "mm");
  EXPECT_TRUE(volume.warnings.empty());
}

TEST_F(DicomSeries, UnequalStepsAreSaid) {
  addRamp(kFirst.y + 5);
  const DenseVolume volume = readVolume(folder());
  EXPECT_TRUE(mentions(volume.warnings, "steps from slice to slice are 1.5 to 3.5"));
  expectNear(placeOf(volume, {0, 0, 2}), kFirst + Vec3d{0, 5, 0});
}

TEST_F(DicomSeries, SlicesWithScalesOfTheirOwnAreSinglePrecision) {
  addRamp();
  add("c", {.z = 1, .y = kFirst.y + 1.5, .slope = "4", .intercept = "0"});
  const DenseVolume volume = readVolume(folder());
  EXPECT_EQ(volume.view.type, ScalarType::kFloat32);
  EXPECT_EQ(valueAt<float>(volume.view, 1, 2, 0), 2 * rampAt(1, 2, 0) - 1000);
  EXPECT_EQ(valueAt<float>(volume.view, 1, 2, 1), 4 * rampAt(1, 2, 1));
}

TEST_F(DicomSeries, OneOfSeveralIsChosen) {
  addRamp();
  add("d", {.series = "1.2.4"});
  const std::string error = errorOfReading(folder());
  EXPECT_NE(error.find("holds 2 series; --series takes one of them"), std::string::npos) << error;
  expectRamp<std::int16_t>(readVolume(folder(), {.series = "1.2.3"}), 2, -1000);
  EXPECT_EQ(readVolume(folder(), {.series = "2"}).view.size[2], 1);
}

TEST_F(DicomSeries, AFileOfSeveralFrames) {
  const auto path = mFolder / "frames.dcm";
  writeContents(path, fileOf({.frames = 3}));
  const DenseVolume volume = readVolume(path);
  expectRamp<std::int16_t>(volume, 2, -1000);
  expectNear(placeOf(volume, {0, 0, 2}), kFirst + Vec3d{0, 18, 0});  // By the thickness: nothing else is said.
}

TEST_F(DicomSeries, WithoutPositionsTheNumbersDecide) {
  add("b", {.z = 0, .instance = 1, .placed = false});
  add("a", {.z = 1, .instance = 2, .placed = false});
  add("c", {.z = 2, .instance = 3, .placed = false});
  const DenseVolume volume = readVolume(folder());
  expectRamp<std::int16_t>(volume, 2, -1000);
  EXPECT_TRUE(mentions(volume.warnings, "does not say where its slices are"));
  EXPECT_EQ(volume.space, "");
}

TEST_F(DicomSeries, DamagedFilesAreOneLine) {
  addRamp();
  const std::string whole = fileOf({.z = 1, .y = kFirst.y + 1.5});
  for (std::size_t kept = 133; kept < whole.size(); kept += 3) {
    writeContents(folder() / "c", whole.substr(0, kept));
    std::string said = errorOfReading(folder());
    if (said.empty() && mentions(readVolume(folder()).warnings, "1 DICOM files without pictures are passed over"))
      said = "a warning";
    EXPECT_NE(said, "") << kept;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace pdc
