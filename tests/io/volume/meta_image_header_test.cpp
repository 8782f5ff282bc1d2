#include "io/volume/volume_files.h"

namespace pdc {
namespace {

const std::string kFields = "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_SHORT\n";

class MetaImageHeader : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& fields, const std::string& data, const std::string& values = "",
                              const char* name = "a.mha") const {
    writeContents(mFolder / name, fields + "ElementDataFile = " + data + "\n" + values);
    return mFolder / name;
  }
  TemporaryFolder mFolder;
};

TEST_F(MetaImageHeader, LocalSeparateAndCompressedValues) {
  const std::string values = rampBytes<std::int16_t>();
  expectRamp<std::int16_t>(readVolume(write(kFields, "LOCAL", values)));
  expectRamp<std::int16_t>(readVolume(write(kFields + "CompressedData = True\n", "LOCAL", deflated(values, 15))));
  writeContents(mFolder / "v.raw", values);
  expectRamp<std::int16_t>(readVolume(write(kFields, "v.raw", "", "a.mhd")));
  writeContents(mFolder / "h.raw", "head" + values);
  expectRamp<std::int16_t>(readVolume(write(kFields + "HeaderSize = 4\n", "h.raw", "", "a.mhd")));
  expectRamp<std::int16_t>(readVolume(write(kFields + "HeaderSize = -1\n", "h.raw", "", "a.mhd")));
}

TEST_F(MetaImageHeader, BigEndianValues) {
  for (const char* field : {"BinaryDataByteOrderMSB = True\n", "ElementByteOrderMSB = True\n"})
    expectRamp<std::int16_t>(readVolume(write(kFields + field, "LOCAL", rampBytes<std::int16_t>(true))));
}

TEST_F(MetaImageHeader, ListsAndPatternsOfSlices) {
  const std::string values = rampBytes<std::int16_t>();
  const std::size_t slice = values.size() / 3;
  for (std::size_t i = 0; i < 3; ++i)
    writeContents(mFolder / std::string("s").append(std::to_string(i + 1)).append(".raw"),
                  values.substr(i * slice, slice));
  expectRamp<std::int16_t>(readVolume(write(kFields, "LIST", "s1.raw\ns2.raw\ns3.raw\n", "a.mhd")));
  expectRamp<std::int16_t>(readVolume(write(kFields, "s%d.raw 1 3 1", "", "a.mhd")));
  EXPECT_NE(errorOfReading(write(kFields, "LIST", "s1.raw\ns2.raw\n", "a.mhd")).find("s1.raw: ends early"),
            std::string::npos);
}

TEST_F(MetaImageHeader, RowsOfTheMatrixAreDirectionsOfAxes) {
  const DenseVolume volume =
      readVolume(write(kFields + "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 2 3 4\n",
                       "LOCAL", rampBytes<std::int16_t>()));
  expectNear(placeOf(volume, {1, 0, 0}), {10, 22, 30});
  expectNear(placeOf(volume, {0, 1, 0}), {7, 20, 30});
  expectNear(placeOf(volume, {0, 0, 1}), {10, 20, 34});
  EXPECT_EQ(volume.space, "LPS");
  const DenseVolume ras = readVolume(mFolder / "a.mha", {.frame = WorldFrame::kRas});
  expectNear(placeOf(ras, {1, 0, 0}), {-10, -22, 30});
}

TEST_F(MetaImageHeader, MirroredAndShearedMatricesAreTaken) {
  const DenseVolume volume =
      readVolume(write(kFields + "TransformMatrix = -1 0 0 0.5 1 0 0 0 1\nPosition = 1 2 3\nElementSpacing = 1 2 1\n",
                       "LOCAL", rampBytes<std::int16_t>()));
  expectNear(placeOf(volume, {1, 1, 1}), {1 - 1 + 1, 4, 4});
  EXPECT_LT(volume.linear.determinant(), 0);
}

TEST_F(MetaImageHeader, MissingSpacingIsSaid) {
  EXPECT_TRUE(mentions(readVolume(write(kFields, "LOCAL", rampBytes<std::int16_t>())).warnings, "spacing"));
}

TEST_F(MetaImageHeader, BadHeadersAreOneLine) {
  const std::string values = rampBytes<std::int16_t>();
  EXPECT_NE(errorOfReading(write(kFields, "LOCAL", values.substr(2))).find("ends early"), std::string::npos);
  EXPECT_NE(errorOfReading(write(kFields, "gone.raw")).find("gone.raw"), std::string::npos);
  EXPECT_NE(errorOfReading(write(kFields + "ElementNumberOfChannels = 3\n", "LOCAL", values)).find("3 values a point"),
            std::string::npos);
  EXPECT_NE(errorOfReading(write("NDims = 3\nDimSize = 5 4 3\nElementType = MET_STRING\n", "LOCAL", values))
                .find("\"MET_STRING\""),
            std::string::npos);
  writeContents(mFolder / "b.mha", "NDims = 3\n");
  EXPECT_NE(errorOfReading(mFolder / "b.mha").find("no line \"ElementDataFile"), std::string::npos);
  EXPECT_NE(errorOfReading(write(kFields + "CompressedData = True\n", "LOCAL", "no deflated data")).find("damaged"),
            std::string::npos);
}

}  // namespace
}  // namespace pdc
