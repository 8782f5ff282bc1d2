#include "io/vdb/vdb_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "io/vdb/vdb_files.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

/// Damage at places where OpenVDB itself would write past a buffer, allocate without limit or never end.
class DamagedVdb : public VdbFiles {
 protected:
  /// The bytes of a file with the sphere in it.
  std::string sphereFile(std::uint32_t compression) { return contentsOf(write({sphere()}, compression)); }

  std::string errorOfBytes(const std::string& bytes) {
    const fs::path path = mFolder / "damaged.vdb";
    writeContents(path, bytes);
    const std::string listed = errorOfListing(path);
    EXPECT_EQ(errorOfReading(path), listed);
    return listed;
  }

  template <typename Number>
  static void put(std::string& bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof(number));
  }

  // Header: magic, version, library version, offsets flag, uuid; no metadata; one grid. Then the descriptor.
  static constexpr std::size_t kVersionAt = 8, kMetadataAt = 21 + 36, kGridsAt = kMetadataAt + 4,
                               kNameAt = kGridsAt + 4;
};

TEST_F(DamagedVdb, UndamagedFileIsRead) { EXPECT_EQ(errorOfBytes(sphereFile(kNone)), ""); }

TEST_F(DamagedVdb, VersionsThatAreTooOldOrTooNew) {
  for (const std::uint32_t version : {0u, 221u, 225u, 0xffffffffu}) {
    std::string bytes = sphereFile(kNone);
    put(bytes, kVersionAt, version);
    EXPECT_NE(errorOfBytes(bytes).find("VDB file version " + std::to_string(version)), std::string::npos);
  }
}

TEST_F(DamagedVdb, CountsAndLengthsThatLie) {
  for (const std::size_t at : {kMetadataAt, kGridsAt, kNameAt}) {
    std::string bytes = sphereFile(kNone);
    put(bytes, at, std::uint32_t{0x7fffffff});
    EXPECT_NE(errorOfBytes(bytes), "") << at;
  }
}

TEST_F(DamagedVdb, BlocksOfValuesThatAreLargerThanTheirNode) {
  for (const std::uint32_t compression : {kZip, kBlosc}) {
    const auto grid = sphere();
    grid->setGridClass(openvdb::GRID_UNKNOWN);  // level sets are not zipped
    const std::string good = contentsOf(write({grid}, compression));
    std::int64_t gridAt, blockAt;
    const std::size_t offsetsAt = kNameAt + 4 + 6 + 4 + std::strlen("Tree_float_5_4_3") + 4;
    std::memcpy(&gridAt, good.data() + offsetsAt, sizeof(gridAt));
    std::memcpy(&blockAt, good.data() + offsetsAt + 8, sizeof(blockAt));
    // The first leaf: its mask, the kind of its values, and the size of the block.
    const auto sizeAt = static_cast<std::size_t>(blockAt) + 64 + 1;
    for (const std::int64_t size : {std::int64_t{-100000}, std::int64_t{-2047}, std::int64_t{0}, std::int64_t{1} << 40,
                                    std::numeric_limits<std::int64_t>::min()}) {
      std::string bytes = good;
      put(bytes, sizeAt, size);
      EXPECT_NE(errorOfBytes(bytes), "") << size;
    }
  }
}

TEST_F(DamagedVdb, EveryTruncationIsAnError) {
  const std::string good = sphereFile(kNone);
  for (std::size_t size = 1; size < good.size(); size += 1 + size / 4)
    EXPECT_NE(errorOfBytes(good.substr(0, size)), "") << size;
  EXPECT_NE(errorOfBytes(good.substr(0, good.size() - 1)), "");
}

}  // namespace
}  // namespace pdc
