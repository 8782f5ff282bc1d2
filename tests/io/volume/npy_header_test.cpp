#include "io/volume/volume_files.h"

namespace pdc {
namespace {

/// An array file. \param version of the format, whose header's length has two or four bytes.
std::string npy(const std::string& dictionary, const std::string& values, int version = 1) {
  const std::string header = dictionary + "\n";
  std::string file = "\x93NUMPY";
  file += static_cast<char>(version);
  file += '\0';
  file += version == 1 ? bytesOf(static_cast<std::uint16_t>(header.size()))
                       : bytesOf(static_cast<std::uint32_t>(header.size()));
  return file + header + values;
}

/// The ramp's values with z running fastest, as C orders arrays indexed [x, y, z].
std::string rampInC() {
  std::string bytes;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 3; ++z) bytes += bytesOf(static_cast<std::int16_t>(rampAt(x, y, z)));
  return bytes;
}

const std::string kInC = "{'descr': '<i2', 'fortran_order': False, 'shape': (5, 4, 3), }";

/// A zip file of these files, with the sizes of the last in 64 bits where asked.
std::string zip(const std::vector<std::pair<std::string, std::string>>& files, bool compress, bool wide = false) {
  std::string bytes, list;
  for (const auto& [name, content] : files) {
    const std::string packed = compress ? deflated(content, -15) : content;
    const std::string sizes =
        bytesOf(static_cast<std::uint32_t>(packed.size())) + bytesOf(static_cast<std::uint32_t>(content.size()));
    const std::string extra = wide ? bytesOf(std::uint16_t{1}) + bytesOf(std::uint16_t{16}) +
                                         bytesOf(std::uint64_t{content.size()}) + bytesOf(std::uint64_t{packed.size()})
                                   : "";
    const std::string common =
        bytesOf(std::uint16_t{45}) + bytesOf(std::uint16_t{0}) + bytesOf(static_cast<std::uint16_t>(compress ? 8 : 0)) +
        bytesOf(std::uint32_t{0}) + bytesOf(std::uint32_t{0}) + (wide ? std::string(8, '\xff') : sizes) +
        bytesOf(static_cast<std::uint16_t>(name.size())) + bytesOf(static_cast<std::uint16_t>(extra.size()));
    list += "PK\x01\x02" + bytesOf(std::uint16_t{45}) + common + std::string(10, '\0') +
            bytesOf(static_cast<std::uint32_t>(bytes.size())) + name + extra;
    bytes += "PK\x03\x04" + common + name + extra + packed;
  }
  const auto count = static_cast<std::uint16_t>(files.size());
  return bytes + list + "PK\x05\x06" + std::string(4, '\0') + bytesOf(count) + bytesOf(count) +
         bytesOf(static_cast<std::uint32_t>(list.size())) + bytesOf(static_cast<std::uint32_t>(bytes.size())) +
         std::string(2, '\0');
}

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
