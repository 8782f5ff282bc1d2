#include "io/volume/npy_files.h"

namespace pdc {
namespace {

/// The ramp's values with z running fastest, as C orders arrays indexed [x, y, z].
std::string rampInC() {
  std::string bytes;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 3; ++z) bytes += bytesOf(static_cast<std::int16_t>(rampAt(x, y, z)));
  return bytes;
}

const std::string kInC = "{'descr': '<i2', 'fortran_order': False, 'shape': (5, 4, 3), }";

class NpyHeader : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& content, const char* name = "a.npy") const {
    writeContents(mFolder / name, content);
    return mFolder / name;
  }
  TemporaryFolder mFolder;
};

TEST_F(NpyHeader, ArraysAreIndexedXyzInEitherOrder) {
  for (const int version : {1, 2, 3}) expectRamp<std::int16_t>(readVolume(write(npy(kInC, rampInC(), version))));
  expectRamp<std::int16_t>(
      readVolume(write(npy("{'descr': '<i2', 'fortran_order': True, 'shape': (5, 4, 3)}", rampBytes<std::int16_t>()))));
  expectRamp<double>(
      readVolume(write(npy("{'shape': (5, 4, 3), 'fortran_order': True, 'descr': '>f8'}", rampBytes<double>(true)))));
}

TEST_F(NpyHeader, OtherArraysAreRefusedInALine) {
  EXPECT_NE(errorOfReading(write(npy("{'descr': '<i2', 'fortran_order': False, 'shape': (5, 4)}", rampInC())))
                .find("2 dimensions"),
            std::string::npos);
  EXPECT_NE(errorOfReading(write(npy("{'descr': '<c8', 'fortran_order': False, 'shape': (5, 4, 3)}", rampInC())))
                .find("type 'c8'"),
            std::string::npos);
  EXPECT_NE(
      errorOfReading(write(npy("{'descr': [('a', '<i2')], 'fortran_order': False, 'shape': (5, 4, 3)}", rampInC())))
          .find("several fields"),
      std::string::npos);
  EXPECT_NE(errorOfReading(write(npy(kInC, rampInC().substr(1)))).find("ends early"), std::string::npos);
  EXPECT_NE(errorOfReading(write("\x93NUMPY\x01")).find("not an array of NumPy"), std::string::npos);
  EXPECT_NE(errorOfReading(write(npy("{'descr': '<i2', 'fortran_order': False, 'shape': (0, 4, 3)}", "")))
                .find("a size is 0"),
            std::string::npos);
}

TEST_F(NpyHeader, ZipFilesStoredAndDeflated) {
  for (const bool compress : {false, true})
    for (const bool wide : {false, true}) {
      const DenseVolume volume =
          readVolume(write(zip({{"volume.npy", npy(kInC, rampInC())}}, compress, wide), "a.npz"));
      expectRamp<std::int16_t>(volume);
      EXPECT_EQ(volume.encoding, compress ? "deflate" : "raw");
    }
}

TEST_F(NpyHeader, OneOfSeveralArraysIsTaken) {
  const std::string affine = npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4)}", std::string(128, '\0'));
  expectRamp<std::int16_t>(
      readVolume(write(zip({{"affine.npy", affine}, {"ct.npy", npy(kInC, rampInC())}}, true), "a.npz")));
  const auto two = write(zip({{"ct.npy", npy(kInC, rampInC())}, {"pet.npy", npy(kInC, rampInC())}}, false), "b.npz");
  EXPECT_NE(errorOfReading(two).find("'ct', 'pet'; --array takes one"), std::string::npos);
  expectRamp<std::int16_t>(readVolume(two, {.array = "pet"}));
  EXPECT_NE(errorOfReading(two, {.array = "mr"}).find("no array 'mr'; it has 'ct', 'pet'"), std::string::npos);
}

TEST_F(NpyHeader, DamagedZipFilesAreRefused) {
  const std::string whole = zip({{"ct.npy", npy(kInC, rampInC())}}, true);
  EXPECT_NE(errorOfReading(write(whole.substr(0, whole.size() - 30), "a.npz")).find("not a zip file, or cut off"),
            std::string::npos);
  EXPECT_NE(errorOfReading(write(whole.substr(20), "a.npz")).find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace pdc
