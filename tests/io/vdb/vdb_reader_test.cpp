#include "pdc/io/vdb/vdb_reader.h"

#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "folders.h"
#include "io/vdb/vdb_files.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

/// A tree type that the library does not register.
using OddTree = openvdb::tree::Tree4<float, 4, 3, 3>::Type;
using OddGrid = openvdb::Grid<OddTree>;

class VdbReader : public VdbFiles {};

/// Values in leaves, in tiles of each level, and two inactive values that are not the background.
template <typename Grid>
typename Grid::Ptr variedGrid(const std::string& name, typename Grid::ValueType background) {
  using Value = typename Grid::ValueType;
  const auto grid = Grid::create(background);
  grid->setName(name);
  auto& tree = grid->tree();
  for (int i = 0; i < 200; ++i) tree.setValue(openvdb::Coord(i, 3 * i, -i), Value(i % 100));
  for (int i = 0; i < 200; ++i) tree.setValueOff(openvdb::Coord(i, 3 * i + 1, -i), Value(i % 2 + 5));
  tree.addTile(1, openvdb::Coord(-64, 0, 0), Value(7), true);
  tree.addTile(2, openvdb::Coord(512, 0, 0), Value(8), true);
  tree.addTile(3, openvdb::Coord(8192, 0, 0), Value(9), true);
  tree.addTile(3, openvdb::Coord(-8192, 0, 0), Value(9), false);
  return grid;
}

template <typename Grid>
void expectSameTree(const openvdb::GridBase::Ptr& read, const Grid& written) {
  const auto grid = openvdb::gridPtrCast<Grid>(read);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->background(), written.background());
  EXPECT_EQ(grid->getName(), written.getName());
  EXPECT_EQ(grid->activeVoxelCount(), written.activeVoxelCount());
  EXPECT_TRUE(grid->tree().hasSameTopology(written.tree()));
  std::size_t different = 0;
  for (auto it = written.tree().cbeginValueAll(); it; ++it)
    different += grid->tree().getValue(it.getCoord()) != it.getValue();
  EXPECT_EQ(different, 0u);
  EXPECT_EQ(grid->transform(), written.transform());
}

TEST_F(VdbReader, ReadsBackEachTypeWithEachCompression) {
  for (const std::uint32_t compression : {kNone, kMask, kZip, kZip | kMask, kBlosc, kBlosc | kMask}) {
    SCOPED_TRACE(openvdb::io::compressionToString(compression));
    const auto f = variedGrid<openvdb::FloatGrid>("float", 0.5f);
    const auto d = variedGrid<openvdb::DoubleGrid>("double", -2.0);
    const auto i = variedGrid<openvdb::Int32Grid>("int32", -3);
    const auto l = variedGrid<openvdb::Int64Grid>("int64", 4);
    const auto b = variedGrid<openvdb::BoolGrid>("bool", false);
    const auto empty = openvdb::FloatGrid::create(1.0f);
    empty->setName("empty");
    const fs::path path = write({f, d, i, l, b, empty}, compression);
    expectSameTree(readVdbGrid(path, "float"), *f);
    expectSameTree(readVdbGrid(path, "double"), *d);
    expectSameTree(readVdbGrid(path, "int32"), *i);
    expectSameTree(readVdbGrid(path, "int64"), *l);
    expectSameTree(readVdbGrid(path, "bool"), *b);
    expectSameTree(readVdbGrid(path, "empty"), *empty);
  }
}

TEST_F(VdbReader, HalvesArriveAsFloatsAndDoubles) {
  for (const std::uint32_t compression : {kNone, kZip | kMask, kBlosc | kMask}) {
    const auto f = variedGrid<openvdb::FloatGrid>("float", 0.5f);
    const auto d = variedGrid<openvdb::DoubleGrid>("double", -2.0);
    const auto i = variedGrid<openvdb::Int32Grid>("int32", 1 << 20);
    for (const openvdb::GridBase::Ptr& grid :
         {openvdb::GridBase::Ptr(f), openvdb::GridBase::Ptr(d), openvdb::GridBase::Ptr(i)})
      grid->setSaveFloatAsHalf(true);
    const fs::path path = write({f, d, i}, compression);
    expectSameTree(readVdbGrid(path, "float"), *f);
    expectSameTree(readVdbGrid(path, "double"), *d);
    expectSameTree(readVdbGrid(path, "int32"), *i);
    for (const VdbGridInfo& info : listVdbGrids(path)) EXPECT_TRUE(info.savedAsHalf);
  }
}

TEST_F(VdbReader, TheOnlyContourableGridNeedsNoName) {
  const auto colour = openvdb::Vec3SGrid::create(openvdb::Vec3f(1));
  colour->setName("colour");
  const auto grid = sphere();
  const fs::path path = write({colour, grid});
  expectSameTree(readVdbGrid(path), *grid);
  EXPECT_TRUE(readVdbGrid(path)->getGridClass() == openvdb::GRID_LEVEL_SET);
  EXPECT_EQ(
      errorOfReading(path, "colour"),
      path.string() + ": grid \"colour\" of type vec3s cannot be contoured; float, double, int32, int64 and bool can");
  EXPECT_EQ(errorOfReading(path, "none"),
            path.string() + ": no grid \"none\"; there is \"sphere\" (float); \"colour\" (vec3s) cannot be contoured");
  const fs::path onlyColour = write({colour});
  EXPECT_EQ(errorOfReading(onlyColour), path.string() + ": no grid can be contoured; there is \"colour\" (vec3s)");
  const fs::path two = write({grid, variedGrid<openvdb::BoolGrid>("b", false)});
  EXPECT_EQ(
      errorOfReading(two),
      path.string() + ": more than one grid can be contoured; choose one by name: \"sphere\" (float), \"b\" (bool)");
  EXPECT_EQ(errorOfReading(write({colour, grid, variedGrid<openvdb::BoolGrid>("b", false)})),
            path.string() +
                ": more than one grid can be contoured; choose one by name: \"sphere\" (float), \"b\" (bool); "
                "\"colour\" (vec3s) cannot be contoured");
  const fs::path none = write({});
  EXPECT_TRUE(listVdbGrids(none).empty());
  EXPECT_EQ(errorOfReading(none), path.string() + ": no grid can be contoured; there is nothing");
}

TEST_F(VdbReader, GridsThatShareANameAreNumbered) {
  const auto first = variedGrid<openvdb::Int32Grid>("density", 1),
             second = variedGrid<openvdb::Int32Grid>("density", 2);
  const auto unnamed = variedGrid<openvdb::Int32Grid>("", 3);
  const fs::path path = write({first, second, unnamed});
  const auto infos = listVdbGrids(path);
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_EQ(infos[0].name, "density[0]");
  EXPECT_EQ(infos[1].name, "density[1]");
  EXPECT_EQ(infos[2].name, "[0]");
  for (const VdbGridInfo& info : infos)
    EXPECT_EQ(openvdb::gridPtrCast<openvdb::Int32Grid>(readVdbGrid(path, info.name))->background(), info.background);
  EXPECT_NE(errorOfReading(path, "density").find("\"density[1]\""), std::string::npos) << "which one?";
  expectSameTree(readVdbGrid(write({unnamed})), *unnamed);
}

TEST_F(VdbReader, GridsThatShareATree) {
  const auto owner = sphere();
  const auto other = openvdb::FloatGrid::create(owner->treePtr());
  other->setName("other");
  other->setTransform(openvdb::math::Transform::createLinearTransform(4.0));
  const fs::path path = write({owner, other});
  expectSameTree(readVdbGrid(path, "other"), *other);
  expectSameTree(readVdbGrid(path, "sphere"), *owner);
  EXPECT_EQ(listVdbGrids(path)[1].activeVoxels, owner->activeVoxelCount());
}

TEST_F(VdbReader, UnknownTypesAreListedAndPassedOver) {
  if (!OddGrid::isRegistered()) OddGrid::registerGrid();
  const auto odd = OddGrid::create(1.0f);
  odd->setName("odd");
  odd->tree().setValue(openvdb::Coord(1, 2, 3), 4.0f);
  const auto grid = sphere();
  const fs::path path = write({odd, grid});
  OddGrid::unregisterGrid();
  const auto infos = listVdbGrids(path);
  ASSERT_EQ(infos.size(), 2u);
  EXPECT_EQ(infos[0].name, "odd");
  EXPECT_EQ(infos[0].valueType, "float");
  EXPECT_FALSE(infos[0].contourable);
  EXPECT_EQ(infos[0].activeVoxels, 1u);
  EXPECT_EQ(infos[0].boundsHi, (std::array<std::int32_t, 3>{1, 2, 3}));
  expectSameTree(readVdbGrid(path), *grid);
}

TEST_F(VdbReader, FileWrittenToAStreamWithoutOffsets) {
  const auto f = variedGrid<openvdb::FloatGrid>("float", 0.5f);
  const auto b = variedGrid<openvdb::BoolGrid>("bool", true);
  const auto shared = openvdb::FloatGrid::create(f->treePtr());
  shared->setName("shared");
  std::ostringstream stream;
  openvdb::io::Stream(stream).write(openvdb::GridCPtrVec{f, shared, b});
  const fs::path path = mFolder / "stream.vdb";
  writeContents(path, stream.str());
  expectSameTree(readVdbGrid(path, "float"), *f);
  expectSameTree(readVdbGrid(path, "shared"), *shared);
  expectSameTree(readVdbGrid(path, "bool"), *b);
}

TEST_F(VdbReader, ListsWhatThereIs) {
  const auto grid = sphere();
  grid->insertMeta("author", openvdb::StringMetadata("somebody"));
  const auto fog = openvdb::DoubleGrid::create(0.0);
  fog->setName("fog");
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  fog->setTransform(openvdb::math::Transform::createFrustumTransform(
      openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(100)), 0.5, 10.0, 0.1));
  fog->tree().setValue(openvdb::Coord(-5, 0, 0), std::numeric_limits<double>::quiet_NaN());
  fog->tree().setValue(openvdb::Coord(1, 0, 0), 0.25);
  fog->tree().setValue(openvdb::Coord(2, 0, 7), 0.75);
  const auto empty = openvdb::Int64Grid::create(-9);
  empty->setName("empty");
  const fs::path path = write({grid, fog, empty});
  const auto infos = listVdbGrids(path);
  ASSERT_EQ(infos.size(), 3u);

  EXPECT_EQ(infos[0].name, "sphere");
  EXPECT_EQ(infos[0].valueType, "float");
  EXPECT_EQ(infos[0].gridClass, "level set");
  EXPECT_EQ(infos[0].transform, "uniform scale");
  EXPECT_FALSE(infos[0].savedAsHalf);
  EXPECT_TRUE(infos[0].contourable);
  EXPECT_EQ(infos[0].activeVoxels, grid->activeVoxelCount());
  EXPECT_EQ(infos[0].voxelSize, (std::array<double, 3>{0.5, 0.5, 0.5}));
  EXPECT_FLOAT_EQ(static_cast<float>(infos[0].background), 1.5f);
  EXPECT_LT(infos[0].valueMin, -1.4);
  EXPECT_GT(infos[0].valueMax, 1.4);
  const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
  EXPECT_EQ(infos[0].boundsLo, (std::array<std::int32_t, 3>{box.min().x(), box.min().y(), box.min().z()}));
  EXPECT_EQ(infos[0].boundsHi, (std::array<std::int32_t, 3>{box.max().x(), box.max().y(), box.max().z()}));

  EXPECT_EQ(infos[1].gridClass, "fog volume");
  EXPECT_EQ(infos[1].transform, "frustum");
  EXPECT_EQ(infos[1].activeVoxels, 3u);
  EXPECT_EQ(infos[1].boundsLo, (std::array<std::int32_t, 3>{-5, 0, 0}));
  EXPECT_EQ(infos[1].valueMin, 0.25);
  EXPECT_EQ(infos[1].valueMax, 0.75);

  EXPECT_EQ(infos[2].valueType, "int64");
  EXPECT_EQ(infos[2].gridClass, "unknown");
  EXPECT_EQ(infos[2].background, -9);
  EXPECT_EQ(infos[2].activeVoxels, 0u);
  EXPECT_GT(infos[2].boundsLo[0], infos[2].boundsHi[0]);

  const auto read = readVdbGrid(path, "sphere");
  EXPECT_EQ(read->metaValue<std::string>("author"), "somebody");
}

TEST_F(VdbReader, EachTransformComesBack) {
  using openvdb::math::Transform;
  const auto affine = Transform::createLinearTransform(2.0);
  affine->postRotate(0.3, openvdb::math::X_AXIS);
  affine->postTranslate(openvdb::Vec3d(1, 2, 3));
  const auto scale = Transform::createLinearTransform(1.0);
  scale->postScale(openvdb::Vec3d(1, 2, 3));
  const auto scaleTranslation = scale->copy();
  scaleTranslation->postTranslate(openvdb::Vec3d(1, 2, 3));
  const auto translation = Transform::createLinearTransform(3.0);
  translation->postTranslate(openvdb::Vec3d(1, 2, 3));
  const auto frustum =
      Transform::createFrustumTransform(openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(9)), 0.5, 2, 1);
  const std::vector<std::pair<Transform::Ptr, std::string>> all = {{affine, "affine"},
                                                                   {scale, "scale"},
                                                                   {scaleTranslation, "scale, translation"},
                                                                   {translation, "uniform scale, translation"},
                                                                   {frustum, "frustum"}};
  for (const auto& [transform, kind] : all) {
    SCOPED_TRACE(kind);
    const auto grid = sphere();
    grid->setTransform(transform);
    const fs::path path = write({grid});
    EXPECT_EQ(listVdbGrids(path)[0].transform, kind);
    expectSameTree(readVdbGrid(path), *grid);
  }
}

TEST_F(VdbReader, FilesThatCannotBeReadAreErrors) {
  const std::string missing = (mFolder / "missing.vdb").string();
  EXPECT_EQ(errorOfReading(missing), missing + ": cannot be read: No such file or directory");
  EXPECT_EQ(errorOfListing(mFolder.path()), mFolder.path().string() + ": cannot be read: Is a directory");
  const fs::path path = mFolder / "bad.vdb";
  writeContents(path, "");
  EXPECT_EQ(errorOfListing(path), path.string() + ": the file is empty");
  writeContents(path, "ply\nformat ascii 1.0\n");
  EXPECT_EQ(errorOfListing(path), path.string() + ": not a VDB file");
}

struct RealGrid {
  const char* file;
  const char* name;
  const char* type;
  const char* gridClass;
  const char* transform;
  bool half;
  std::size_t activeVoxels;
  double background, valueMin, valueMax;
};

void PrintTo(const RealGrid& grid, std::ostream* out) { *out << grid.file << ", " << grid.name; }

class RealVdb : public testing::TestWithParam<RealGrid> {};

TEST_P(RealVdb, HasTheFiguresOfTheManifest) {
  const RealGrid& expected = GetParam();
  const fs::path path = test::dataFolder() / "vdb" / expected.file;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto infos = listVdbGrids(path);
  const auto info = std::find_if(infos.begin(), infos.end(), [&](const auto& i) { return i.name == expected.name; });
  ASSERT_TRUE(info != infos.end());
  EXPECT_EQ(info->valueType, expected.type);
  EXPECT_EQ(info->gridClass, expected.gridClass);
  EXPECT_EQ(info->transform, expected.transform);
  EXPECT_EQ(info->savedAsHalf, expected.half);
  EXPECT_EQ(info->activeVoxels, expected.activeVoxels);
  EXPECT_NEAR(info->background, expected.background, 1e-6);
  EXPECT_NEAR(info->valueMin, expected.valueMin, 1e-6);
  EXPECT_NEAR(info->valueMax, expected.valueMax, 1e-6);
  if (info->contourable) {
    EXPECT_EQ(readVdbGrid(path, info->name)->activeVoxelCount(), expected.activeVoxels);
  } else {
    EXPECT_NE(errorOfReading(path, info->name), "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Manifest, RealVdb,
    testing::Values(
        RealGrid{"ovdb_icosahedron.vdb", "ls_icosahedron", "float", "level set", "uniform scale", true, 364741,
                 0.150024, -0.150024, 0.150024},
        RealGrid{"ovdb_sphere.vdb", "ls_sphere", "float", "level set", "uniform scale", true, 270638, 0.150024,
                 -0.149536, 0.149658},
        RealGrid{"mpm_bullet.vdb", "surface", "float", "level set", "uniform scale", false, 49680, 0.015, -0.0149928,
                 0.0149981},
        RealGrid{"vpt_dragon_affine.vdb", "density", "float", "fog volume", "affine", false, 156161, 0, 1.98682e-06, 1},
        RealGrid{"oiio_sphere_mask.vdb", "density", "float", "fog volume", "uniform scale", false, 9047, 0, 0, 1},
        RealGrid{"oiio_sphere_cd_vec3s.vdb", "Cd", "vec3s", "unknown", "uniform scale", false, 9047, 0, 0, 0},
        RealGrid{"blender_density_heat.vdb", "density", "float", "unknown", "scale, translation", false, 6124, 0,
                 0.00100112, 0.997509},
        RealGrid{"blender_density_heat.vdb", "heat", "float", "unknown", "scale, translation", false, 5224, 0,
                 0.00100018, 0.759538},
        RealGrid{"points_sphere.vdb", "points", "ptdataidx32", "unknown", "uniform scale", false, 1178, 0, 0, 0},
        RealGrid{"derived_bunny_ls_f32_blosc.vdb", "mesh2ls_bunny_closed", "float", "level set", "uniform scale", false,
                 340333, 0.0030331, -0.0030331, 0.00303298},
        RealGrid{"derived_fandisk_ls_half_mask.vdb", "mesh2ls_fandisk_13k", "float", "level set", "uniform scale", true,
                 195048, 0.0491943, -0.0491943, 0.0491638},
        RealGrid{"derived_wingnut_sdf_zip_unknown.vdb", "sdf", "float", "unknown", "uniform scale", false, 57679,
                 0.239958, -0.239942, 0.239953},
        RealGrid{"damaged/bad-bbox-overflow.vdb", "overflow", "float", "unknown", "uniform scale", false, 0, 0, 0, 0},
        RealGrid{"damaged/bad-bbox-inverted.vdb", "inverted", "float", "unknown", "uniform scale", false, 0, 0, 0, 0}),
    [](const auto& parameter) {
      std::string name = parameter.param.file + std::string("_") + parameter.param.name;
      for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      return name;
    });

TEST(RealVdbFile, TruncatedIsAnError) {
  const fs::path path = test::dataFolder() / "vdb/damaged/truncated.vdb";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  EXPECT_NE(errorOfListing(path).find("ends early"), std::string::npos);
  EXPECT_NE(errorOfReading(path), "");
}

}  // namespace
}  // namespace pdc
