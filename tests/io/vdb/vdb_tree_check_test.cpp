#include "io/vdb/vdb_tree_check.h"

#include <cstring>
#include <sstream>

#include "io/file/byte_reader.h"
#include "io/vdb/vdb_files.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kCountBytes = 4, kFloatBytes = 4, kOriginBytes = 12;
constexpr std::size_t kTilesAt = kCountBytes + kFloatBytes, kChildrenAt = kTilesAt + kCountBytes,
                      kFirstTileAt = kChildrenAt + kCountBytes, kTileBytes = kOriginBytes + kFloatBytes + 1;
/// Masks of a node of 32³ values: 4096 bytes each.
constexpr std::size_t kMaskBytes = 4096;

/// A tree with one tile and two nodes in its root; each node holds a leaf with one active voxel.
template <typename Grid>
typename Grid::Ptr smallGrid() {
  auto grid = Grid::create();
  const typename Grid::ValueType one(1);
  grid->tree().root().addTile({8192, 0, 0}, one, true);
  grid->tree().setValue({1, 2, 3}, one);
  grid->tree().setValue({-4000, 0, 0}, one);
  return grid;
}

class VdbTreeCheck : public VdbFiles {
 protected:
  static std::string bytesOf(const openvdb::GridBase& grid, std::uint32_t compression) {
    std::ostringstream stream;
    openvdb::io::setVersion(stream, {openvdb::OPENVDB_LIBRARY_MAJOR_VERSION, openvdb::OPENVDB_LIBRARY_MINOR_VERSION},
                            openvdb::OPENVDB_FILE_VERSION);
    openvdb::io::setDataCompression(stream, compression);
    grid.writeTopology(stream);
    grid.writeBuffers(stream);
    return stream.str();
  }

  /// The error of a check of these bytes; where there is none, the check must have walked to the end of the tree, which
  /// a few other bytes follow.
  [[nodiscard]] std::string errorOfTree(const std::string& bytes, const VdbTreeFormat& format) const {
    const auto path = mFolder / "tree";
    writeContents(path, bytes + "more");
    return errorOf([&] {
      ByteReader reader(path);
      checkVdbTree(reader, format);
      EXPECT_EQ(reader.position(), bytes.size());
    });
  }

  /// Expects that the small float grid, changed at one place, is refused with this message.
  template <typename Number>
  void expectRefused(std::size_t at, Number number, const char* what) const {
    std::string bytes = bytesOf(*smallGrid<openvdb::FloatGrid>(), kNone);
    ASSERT_EQ(errorOfTree(bytes, {.type = "Tree_float_5_4_3"}), "");
    ASSERT_LE(at + sizeof(number), bytes.size());
    std::memcpy(bytes.data() + at, &number, sizeof(number));
    const std::string error = errorOfTree(bytes, {.type = "Tree_float_5_4_3"});
    EXPECT_NE(error.find(std::string(": ") + what), std::string::npos) << error;
    EXPECT_EQ(error.rfind("damaged at byte ", 0), 0U) << error;
  }
};

TEST_F(VdbTreeCheck, WalksToTheEndOfWhatOpenVdbWrites) {
  for (const std::uint32_t compression : {kNone, kMask, kZip, kBlosc, kMask | kZip, kMask | kBlosc}) {
    for (const bool half : {false, true}) {
      const auto expectWalked = [&](openvdb::GridBase& grid) {
        grid.setSaveFloatAsHalf(half);
        const VdbTreeFormat format{.type = grid.type(), .compression = compression, .half = half};
        ASSERT_TRUE(isSampledVdbTree(format.type)) << format.type;
        EXPECT_EQ(errorOfTree(bytesOf(grid, compression), format), "") << format.type << ' ' << compression << half;
      };
      expectWalked(*smallGrid<openvdb::FloatGrid>());
      expectWalked(*smallGrid<openvdb::DoubleGrid>());
      expectWalked(*smallGrid<openvdb::Int32Grid>());
      expectWalked(*smallGrid<openvdb::Int64Grid>());
      expectWalked(*smallGrid<openvdb::BoolGrid>());
      expectWalked(*smallGrid<openvdb::Vec3SGrid>());
      expectWalked(*smallGrid<openvdb::Vec3DGrid>());
      expectWalked(*smallGrid<openvdb::Vec3IGrid>());
      expectWalked(*sphere());
      expectWalked(*openvdb::FloatGrid::create());
    }
  }
}

TEST_F(VdbTreeCheck, RefusesFormatsThatItDoesNotKnow) {
  const std::string bytes = bytesOf(*smallGrid<openvdb::FloatGrid>(), kNone);
  EXPECT_FALSE(isContourableVdbTree("Tree_vec3s_5_4_3"));
  EXPECT_TRUE(isContourableVdbTree("Tree_float_5_4_3"));
  EXPECT_FALSE(isSampledVdbTree("Tree_vec2s_5_4_3"));
  EXPECT_EQ(errorOfTree(bytes, {.type = "Tree_vec2s_5_4_3"}), "trees of type Tree_vec2s_5_4_3 cannot be read");
  EXPECT_EQ(errorOfTree(bytes, {.type = "Tree_float_5_4_3", .compression = 8}), "compression 0x8 is unknown");
}

TEST_F(VdbTreeCheck, RefusesARootThatCannotBe) {
  expectRefused(0, std::int32_t{2}, "number of buffers");
  expectRefused(kFirstTileAt + kTileBytes - 1, char{2}, "tile");
  expectRefused(kFirstTileAt, std::int32_t{1}, "origin of a node");
  expectRefused(kFirstTileAt + kTileBytes, std::int32_t{-4095}, "origin of a node");
  // The tile lies at (8192, 0, 0), the first node at (-4096, 0, 0).
  expectRefused(kFirstTileAt, std::int32_t{-4096}, "two nodes at one place");
}

TEST_F(VdbTreeCheck, RefusesNodesThatCannotBe) {
  constexpr std::size_t kNodeAt = kFirstTileAt + kTileBytes + kOriginBytes;
  const std::string bytes = bytesOf(*smallGrid<openvdb::FloatGrid>(), kNone);
  const std::string children = bytes.substr(kNodeAt, kMaskBytes);
  const std::size_t child = children.find_first_not_of('\0');
  ASSERT_NE(child, std::string::npos);
  expectRefused(kNodeAt + kMaskBytes + child, children[child], "a node both child and active tile");
  expectRefused(kNodeAt + 2 * kMaskBytes, char{7}, "kind of values");
  expectRefused(kNodeAt + 2 * kMaskBytes, char{-1}, "kind of values");
}

TEST_F(VdbTreeCheck, RefusesBoolsOtherThanTrueAndFalse) {
  for (const std::uint32_t compression : {kNone, kMask}) {
    std::string bytes = bytesOf(*smallGrid<openvdb::BoolGrid>(), compression);
    bytes[kCountBytes] = 2;
    const std::string error = errorOfTree(bytes, {.type = "Tree_bool_5_4_3", .compression = compression});
    EXPECT_NE(error.find("a bool that is neither true nor false"), std::string::npos) << error;
  }
}

TEST_F(VdbTreeCheck, RefusesCompressedValuesOfAnotherSize) {
  const auto grid = sphere();
  grid->setGridClass(openvdb::GRID_UNKNOWN);
  // The values of the first node follow its masks and the kind of values: their stored size, then Blosc's header.
  const std::string bytes = bytesOf(*grid, kBlosc);
  const VdbTreeFormat format{.type = "Tree_float_5_4_3", .compression = kBlosc};
  ASSERT_EQ(errorOfTree(bytes, format), "");
  constexpr std::size_t kNodeAt = kChildrenAt + kCountBytes + kOriginBytes, kSizeAt = kNodeAt + 2 * kMaskBytes + 1;
  std::int64_t stored = 0;
  std::memcpy(&stored, bytes.data() + kSizeAt, sizeof(stored));
  ASSERT_GT(stored, 16);
  for (const std::size_t field : {std::size_t{4}, std::size_t{12}}) {
    std::string changed = bytes;
    ++changed[kSizeAt + sizeof(stored) + field];
    const std::string error = errorOfTree(changed, format);
    EXPECT_NE(error.find("size of a block of values"), std::string::npos) << error;
  }
}

TEST_F(VdbTreeCheck, RefusesTopologyThatCannotBeDecompressed) {
  const auto grid = sphere();
  grid->setGridClass(openvdb::GRID_UNKNOWN);
  std::string bytes = bytesOf(*grid, kZip);
  const VdbTreeFormat format{.type = "Tree_float_5_4_3", .compression = kZip};
  ASSERT_EQ(errorOfTree(bytes, format), "");
  constexpr std::size_t kNodeAt = kChildrenAt + kCountBytes + kOriginBytes, kSizeAt = kNodeAt + 2 * kMaskBytes + 1;
  bytes[kSizeAt + sizeof(std::int64_t)] = 0;  // zlib's header
  const std::string error = errorOfTree(bytes, format);
  EXPECT_NE(error.find("a block of values that cannot be decompressed"), std::string::npos) << error;
}

}  // namespace
}  // namespace pdc::detail
