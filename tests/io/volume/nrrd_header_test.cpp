#include "io/volume/volume_files.h"

namespace pdc {
namespace {

const std::string kFields = "type: short\ndimension: 3\nsizes: 5 4 3\n";

class NrrdHeader : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& fields, const std::string& values, const char* name = "a.nrrd") const {
    writeContents(mFolder / name, "NRRD0004\n# a comment\n" + fields + "\n" + values);
    return mFolder / name;
  }
  TemporaryFolder mFolder;
};

TEST_F(NrrdHeader, RawValuesOfBothByteOrders) {
  expectRamp<std::int16_t>(readVolume(write(kFields + "encoding: raw\nendian: little\n", rampBytes<std::int16_t>())));
  expectRamp<std::int16_t>(readVolume(write(kFields + "encoding: raw\nendian: big\n", rampBytes<std::int16_t>(true))));
}

TEST_F(NrrdHeader, GzipAndText) {
  expectRamp<std::int16_t>(
      readVolume(write(kFields + "encoding: gzip\nendian: big\n", deflated(rampBytes<std::int16_t>(true)))));
  std::string text;
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 5; ++x) text += std::to_string(rampAt(x, y, z)) + (x == 4 ? "\n" : " ");
  expectRamp<std::int16_t>(readVolume(write(kFields + "encoding: ascii\n", text)));
  EXPECT_NE(errorOfReading(write(kFields + "encoding: ascii\n", text.substr(0, text.size() - 5))).find("ends early"),
            std::string::npos);
}

TEST_F(NrrdHeader, SpaceDirectionsAreColumnsAndTheSpaceNamesTheFrame) {
  const DenseVolume volume = readVolume(write(
      kFields + "encoding: raw\nendian: little\nspace: left-posterior-superior\nspace directions: (0,2,0) (-3,0,0) "
                "(0.5,0,4)\nspace origin: (10,20,30)\nspace units: \"mm\" \"mm\" \"mm\"\n",
      rampBytes<std::int16_t>()));
  expectNear(placeOf(volume, {1, 2, 3}), {10 - 6 + 1.5, 20 + 2, 30 + 12});
  EXPECT_EQ(volume.space, "LPS");
  EXPECT_EQ(volume.unit, "mm");
  EXPECT_EQ(volume.orientation, "space directions");
}

TEST_F(NrrdHeader, OtherFramesTurnIntoTheWantedOne) {
  const auto path = write(kFields +
                              "encoding: raw\nendian: little\nspace: left-posterior-superior\nspace directions: "
                              "(1,0,0) (0,1,0) (0,0,1)\nspace origin: (10,20,30)\n",
                          rampBytes<std::int16_t>());
  const DenseVolume ras = readVolume(path, {.frame = WorldFrame::kRas});
  expectNear(placeOf(ras, {1, 1, 1}), {-11, -21, 31});
  EXPECT_EQ(ras.space, "RAS");
  expectNear(placeOf(readVolume(path, {.frame = WorldFrame::kLps}), {1, 1, 1}), {11, 21, 31});
  EXPECT_NE(errorOfReading(write(kFields + "encoding: raw\nendian: little\n", rampBytes<std::int16_t>()),
                           {.frame = WorldFrame::kRas})
                .find("does not say which way its axes point"),
            std::string::npos);
}

TEST_F(NrrdHeader, SpacingsMinsAndCentres) {
  const std::string raw = "encoding: raw\nendian: little\n";
  DenseVolume v =
      readVolume(write(kFields + raw + "spacings: 2 3 4\naxis mins: 10 20 30\n", rampBytes<std::int16_t>()));
  expectNear(placeOf(v, {1, 1, 1}), {12, 23, 34});
  v = readVolume(write(kFields + raw + "axis mins: 10 20 30\naxis maxs: 20 28 36\ncenterings: cell cell cell\n",
                       rampBytes<std::int16_t>()));
  expectNear(placeOf(v, {0, 0, 0}), {11, 21, 31});
  expectNear(placeOf(v, {1, 1, 1}), {13, 23, 33});
  v = readVolume(write(kFields + raw + "axis mins: 10 20 30\naxis maxs: 18 26 34\n", rampBytes<std::int16_t>()));
  expectNear(placeOf(v, {1, 1, 1}), {12, 22, 32});
}

TEST_F(NrrdHeader, MissingSpacingIsSaid) {
  const DenseVolume volume = readVolume(write(kFields + "encoding: raw\nendian: little\n", rampBytes<std::int16_t>()));
  EXPECT_FALSE(volume.spacingKnown);
  EXPECT_TRUE(mentions(volume.warnings, "says nothing of spacing"));
  const DenseVolume said = readVolume(mFolder / "a.nrrd", {.spacing = {{2, 3, 4}}});
  expectNear(placeOf(said, {1, 1, 1}), {2, 3, 4});
  EXPECT_TRUE(said.warnings.empty());
}

TEST_F(NrrdHeader, SkipsOfLinesAndBytes) {
  const std::string values = rampBytes<std::int16_t>();
  const std::string raw = kFields + "encoding: raw\nendian: little\n";
  expectRamp<std::int16_t>(readVolume(write(raw + "byte skip: 3\n", "abc" + values)));
  expectRamp<std::int16_t>(readVolume(write(raw + "line skip: 2\n", "one\ntwo\n" + values)));
  writeContents(mFolder / "v.bin", "who knows how long" + values);
  expectRamp<std::int16_t>(readVolume(write(raw + "byte skip: -1\ndata file: v.bin\n", "", "a.nhdr")));
  writeContents(mFolder / "v.bin", values.substr(1));
  EXPECT_NE(errorOfReading(mFolder / "a.nhdr").find("v.bin: ends early"), std::string::npos);
  const std::string gzip = kFields + "encoding: gzip\nendian: little\nbyte skip: 4\n";
  expectRamp<std::int16_t>(readVolume(write(gzip, deflated("abcd" + values))));
}

TEST_F(NrrdHeader, ListsAndPatternsOfFiles) {
  const std::string values = rampBytes<std::int16_t>(), fields = kFields + "encoding: raw\nendian: little\n";
  const std::size_t slice = values.size() / 3;
  for (std::size_t i = 0; i < 3; ++i)
    writeContents(mFolder / std::string("s0").append(std::to_string(i + 7)).append(".raw"),
                  values.substr(i * slice, slice));
  writeContents(mFolder / "list.nhdr", "NRRD0004\n" + fields + "data file: LIST\ns07.raw\ns08.raw\ns09.raw\n");
  expectRamp<std::int16_t>(readVolume(mFolder / "list.nhdr"));
  expectRamp<std::int16_t>(readVolume(write(fields + "data file: s%02d.raw 7 9 1\n", "", "pattern.nhdr")));
  EXPECT_NE(errorOfReading(write(fields + "data file: s%02d.raw 8 10 1\n", "", "pattern.nhdr")).find("s10.raw"),
            std::string::npos);
  EXPECT_NE(errorOfReading(write(fields + "data file: s%s.raw 8 10 1\n", "", "pattern.nhdr")).find("no pattern"),
            std::string::npos);
}

TEST_F(NrrdHeader, ChannelsAreChosen) {
  const std::string fields =
      "type: uchar\ndimension: 4\nsizes: 2 1 1 2\nkinds: vector domain domain domain\nencoding: raw\n";
  EXPECT_NE(errorOfReading(write(fields, "abcd")).find("has 2 values a point"), std::string::npos);
  const DenseVolume second = readVolume(write(fields, "abcd"), {.channel = 1});
  EXPECT_EQ(valueAt<std::uint8_t>(second.view, 0, 0, 1), 'd');
  EXPECT_NE(errorOfReading(mFolder / "a.nrrd", {.channel = 2}).find("no channel 2"), std::string::npos);
}

TEST_F(NrrdHeader, BadHeadersAreOneLine) {
  const auto error = [&](const std::string& fields) {
    return errorOfReading(write(fields, rampBytes<std::int16_t>()));
  };
  EXPECT_NE(error("type: block\ndimension: 3\nsizes: 5 4 3\nencoding: raw\n").find("\"block\""), std::string::npos);
  EXPECT_NE(error(kFields + "encoding: bzip2\nendian: big\n").find("\"bzip2\" is not read"), std::string::npos);
  EXPECT_NE(error(kFields + "encoding: raw\n").find("does not say \"endian\""), std::string::npos);
  EXPECT_NE(error("type: short\ndimension: 3\nsizes: 5 4\n").find("sizes: 2 values are there, 3"), std::string::npos);
  EXPECT_NE(error("type: short\ndimension: 2\nsizes: 5 4\n").find("2 dimensions"), std::string::npos);
  EXPECT_NE(error(kFields + "encoding: raw\nendian: big\nspace directions: (1,0,0) (2,0,0) (0,0,1)\n").find("singular"),
            std::string::npos);
  EXPECT_NE(error(kFields + "encoding: raw\nendian: big\nspace directions: (1,0,0) (0,1,0) 7\n").find("no vector"),
            std::string::npos);
}

}  // namespace
}  // namespace pdc
