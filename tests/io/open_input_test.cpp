#include "pdc/io/open_input.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <limits>

#include "io/vdb/vdb_files.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

const std::string kScene =
    "voxel_size: 0.25\nbox: [[-2, -1, -1], [2, 1, 1]]\niso: 0.125\nsigma_n: 0.07\nshape: {sphere: {radius: 0.5}}\n";

openvdb::FloatGrid::Ptr sameEverywhere(const openvdb::FloatGrid& grid, const char* name, float value) {
  auto companion = grid.deepCopy();
  companion->setName(name);
  for (auto voxel = companion->beginValueOn(); voxel; ++voxel) voxel.setValue(value);
  return companion;
}

class OpenInput : public VdbFiles {
 protected:
  [[nodiscard]] std::filesystem::path scene(const std::string& text = kScene) const {
    writeContents(mFolder / "a.yaml", text);
    return mFolder / "a.yaml";
  }
  /// A sphere, and noise of its values: good, negative.
  [[nodiscard]] std::filesystem::path grids() const {
    const auto grid = sphere();
    return write({grid, sameEverywhere(*grid, "sigma", 0.125F), sameEverywhere(*grid, "faulty", -1)});
  }
};

std::string errorOfOpening(const std::filesystem::path& path, const InputOptions& options) {
  return errorOf([&] { static_cast<void>(openInput(path, options)); });
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(InputKind, GoesByTheSuffixInAnyCase) {
  EXPECT_EQ(inputKind("a.vdb"), InputKind::kGrid);
  EXPECT_EQ(inputKind("folder.yaml/a.VDB"), InputKind::kGrid);
  EXPECT_EQ(inputKind("a.yaml"), InputKind::kScene);
  EXPECT_EQ(inputKind("a.Yml"), InputKind::kScene);
  for (const char* name : {"a.ply", "a.OBJ", "b/a.off", "a.stl"}) EXPECT_EQ(inputKind(name), InputKind::kMesh) << name;
  for (const char* name : {"vdb", ".vdb", "a.vdb.gz", "a", ""}) EXPECT_EQ(inputKind(name), InputKind::kOther);
}

TEST_F(OpenInput, AGridSaysWhatItsSourceSays) {
  const Input input = openInput(write({sphere()}));
  EXPECT_EQ(input.iso, 0);
  EXPECT_EQ(input.sigmaNormal, std::nullopt);
  EXPECT_EQ(input.field, nullptr);
  EXPECT_EQ(input.planeOrigin, PlaneOrigin::kDistance);
  EXPECT_LT(input.valueNoise, 0.01);
  EXPECT_EQ(input.refusedNoise, 0u);
  const auto same = sphere();
  const Mesh mesh = contour(*input.source), expected = contour(GridSource(same));
  ASSERT_FALSE(mesh.empty());
  EXPECT_EQ(mesh.positions, expected.positions);
}

TEST_F(OpenInput, OptionsReachTheGrid) {
  const auto path = grids();
  const std::size_t values = sphere()->activeVoxelCount();
  const Input input =
      openInput(path, {.iso = 0.25, .hermite = HermiteMode::kGradient, .grid = "sphere", .sigmaGrid = "sigma"});
  EXPECT_EQ(input.iso, 0.25);
  EXPECT_EQ(input.planeOrigin, PlaneOrigin::kGradient);
  EXPECT_EQ(input.refusedNoise, 0u);
  EXPECT_EQ(openInput(path, {.grid = "sphere", .sigmaGrid = "faulty"}).refusedNoise, values);
  EXPECT_EQ(openInput(path, {.grid = "sphere", .weightGrid = "faulty"}).refusedNoise, values);
}

/// A sphere that is positive inside, with its class, or without.
openvdb::FloatGrid::Ptr turned(bool withClass) {
  auto grid = sphere();
  const float background = grid->background();
  for (auto it = grid->beginValueAll(); it; ++it) it.setValue(-*it);
  grid->tree().root().setBackground(-background, false);
  if (!withClass) grid->clearGridClass();
  return grid;
}

double volumeOf(const Input& input) { return analyze(contour(*input.source)).volume; }

TEST_F(OpenInput, AGridThatIsPositiveInsideIsReadSoAndThatIsSaid) {
  const double volume = volumeOf(openInput(write({sphere()})));
  const Input right = openInput(write({turned(false)}));
  EXPECT_EQ(right.meaning->gridClass, GridClass::kLevelSet);
  EXPECT_EQ(right.meaning->insideBy, DecidedBy::kValues);
  EXPECT_TRUE(right.warnings.empty());
  EXPECT_NEAR(volumeOf(right), volume, 1e-3 * volume);
  const auto path = write({turned(true)});
  const Input against = openInput(path);
  ASSERT_EQ(against.warnings.size(), 1u);
  EXPECT_TRUE(mentions(against.warnings[0], "--inside high"));
  EXPECT_NEAR(volumeOf(against), volume, 1e-3 * volume);
  const Input asked = openInput(path, {.inside = InsideValues::kHigh});
  EXPECT_TRUE(asked.warnings.empty());
  EXPECT_NEAR(volumeOf(asked), volume, 1e-3 * volume);
  EXPECT_LT(volumeOf(openInput(path, {.inside = InsideValues::kLow})), 0);
  EXPECT_EQ(openInput(path, {.gridClass = GridClass::kFogVolume}).iso, 0.5);
}

TEST_F(OpenInput, AScenesGridsAreReadAsByThemselves) {
  const double volume = volumeOf(openInput(write({turned(true)})));
  const std::string start = "voxel_size: 0.5\nbox: [[-6, -6, -6], [8, 8, 10]]\nshape: {grid: {file: a.vdb";
  const Input input = openInput(scene(start + "}}\n"));
  EXPECT_FALSE(input.meaning.has_value());
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_TRUE(mentions(input.warnings[0], "grid \"sphere\": the level set's background")) << input.warnings[0];
  EXPECT_TRUE(mentions(input.warnings[0], "inside: high")) << input.warnings[0];
  EXPECT_NEAR(volumeOf(input), volume, 0.02 * volume);
  const Input asked = openInput(scene(start + ", class: level-set, inside: high}}\n"));
  EXPECT_TRUE(asked.warnings.empty());
  EXPECT_NEAR(volumeOf(asked), volume, 0.02 * volume);
  // All around the ball, up to the box.
  EXPECT_NEAR(volumeOf(openInput(scene(start + ", inside: low}}\n"))), 14 * 14 * 16 - volume, 0.1 * 14 * 14 * 16);
  EXPECT_TRUE(mentions(errorOfOpening(scene(start + ", inside: up}}\n"), {}), "inside must be low or high, not 'up'"));
  EXPECT_TRUE(mentions(errorOfOpening(scene(start + ", class: smoke}}\n"), {}), "class must be level-set or fog"));
}

TEST_F(OpenInput, NonFiniteVoxelsAreAnErrorUnlessAccepted) {
  const auto spoiled = sphere();
  spoiled->tree().setValueOn({2, 4, 16}, std::numeric_limits<float>::quiet_NaN());
  const auto path = write({spoiled});
  EXPECT_THROW(static_cast<void>(contour(*openInput(path).source)), Error);
  EXPECT_FALSE(contour(*openInput(path, {.acceptNonFinite = true}).source).empty());
}

TEST_F(OpenInput, FunctionsAndGridsOfScenesMustBeFiniteUnlessThatIsAccepted) {
  const auto spoiled = sphere();
  spoiled->tree().setValueOn({2, 4, 16}, std::numeric_limits<float>::quiet_NaN());
  const std::string head = "box: [[-1, -1, -1], [1, 1, 1]]\nresolution: 8\nshape: ";
  const std::string root = head + "{formula: {expression: sqrt(x) - 0.5}}\n";
  const std::string inScene = head + "{grid: {file: " + write({spoiled}).filename().string() + "}}\n";
  const auto errorOfContouring = [&](const std::string& text, const InputOptions& options) {
    return errorOf([&] { static_cast<void>(contour(*openInput(scene(text), options).source)); });
  };
  EXPECT_TRUE(mentions(errorOfContouring(root, {}), "the first at (-1, -1, -1) is nan; --nan outside"));
  EXPECT_TRUE(mentions(errorOfContouring(inScene, {}), "a.yaml:3:9: 1 voxel is not finite: at (2, 4, 16) it is nan"));
  for (const std::string& text : {root, inScene}) {
    EXPECT_EQ(errorOfContouring(text, {.acceptNonFinite = true}), "");
    EXPECT_EQ(errorOfContouring("nan: outside\n" + text, {}), "");
    EXPECT_NE(errorOfContouring("nan: error\n" + text, {}), "");
  }
}

TEST_F(OpenInput, ASceneSaysItsIsoItsSigmaAndItsFunction) {
  const Input input = openInput(scene());
  EXPECT_EQ(input.iso, 0.125);
  EXPECT_EQ(input.sigmaNormal, 0.07);
  EXPECT_EQ(input.planeOrigin, PlaneOrigin::kFunction);
  EXPECT_DOUBLE_EQ(input.source->map().voxelSize(), 0.25);
  ASSERT_NE(input.field, nullptr);
  for (const Vec3f& p : contour(*input.source).positions) EXPECT_NEAR(length(vecCast<double>(p)), 0.625, 0.05);
  const double x = 0.625, y = 0;
  double value = 1;
  input.field->values({&x, &y, &y, 1}, &value);
  EXPECT_NEAR(value, 0, 1e-12);
}

TEST_F(OpenInput, OptionsReachTheScene) {
  const auto path = scene();
  EXPECT_EQ(openInput(path, {.iso = -0.1}).iso, -0.1);
  EXPECT_DOUBLE_EQ(openInput(path, {.voxelSize = 0.5}).source->map().voxelSize(), 0.5);
  // The longest side of the box is 4.
  EXPECT_DOUBLE_EQ(openInput(path, {.resolution = 32}).source->map().voxelSize(), 0.125);
  EXPECT_TRUE(openInput(path, {.open = true}).source->surfaceBlocks({}).open);
  EXPECT_FALSE(openInput(path).source->surfaceBlocks({}).open);
}

TEST_F(OpenInput, WhyThereIsNoSurface) {
  const auto grid = write({sphere()});
  EXPECT_EQ(openInput(grid, {.iso = 7}).whyEmpty(), "iso 7 is outside of the grid's values, -1.46447 to 1.5");
  EXPECT_EQ(openInput(grid).whyEmpty(), "the grid has no surface at iso 0");
  EXPECT_EQ(openInput(scene(), {.iso = -3}).whyEmpty(), "the scene has no surface at iso -3 in its box");
}

TEST_F(OpenInput, RefusesOptionsOfTheOtherKind) {
  const auto grid = write({sphere()});
  EXPECT_TRUE(mentions(errorOfOpening(grid, {.voxelSize = 1}), "a voxel size goes with scenes and meshes only"));
  EXPECT_TRUE(mentions(errorOfOpening(grid, {.resolution = 9}), "a resolution goes with scenes and meshes only"));
  const InputOptions forGrids[] = {{.grid = "a"}, {.floodFill = true}, {.sigmaGrid = "a"}, {.weightGrid = "a"}};
  for (const InputOptions& options : forGrids)
    EXPECT_TRUE(mentions(errorOfOpening(scene(), options), ".vdb inputs only")) << errorOfOpening(scene(), options);
  const InputOptions forValues[] = {
      {.hermite = HermiteMode::kGradient}, {.gridClass = GridClass::kLevelSet}, {.inside = InsideValues::kLow}};
  for (const InputOptions& options : forValues)
    EXPECT_TRUE(mentions(errorOfOpening(scene(), options), "grids and volumes only"))
        << errorOfOpening(scene(), options);
}

TEST_F(OpenInput, Refusals) {
  EXPECT_TRUE(mentions(errorOfOpening("mesh.txt", {}), "'mesh.txt': not a kind of input"));
  EXPECT_TRUE(mentions(errorOfOpening(mFolder / "none.vdb", {}), "No such file"));
  EXPECT_TRUE(mentions(errorOfOpening(mFolder / "none.yaml", {}), "No such file"));
  EXPECT_TRUE(mentions(errorOfOpening(scene(), {.voxelSize = 1, .resolution = 9}), "excludes"));
  for (const int resolution : {-1, 0, kMaxVoxelsPerAxis + 1})
    EXPECT_TRUE(mentions(errorOfOpening(scene(), {.resolution = resolution}), "from 1 to 1048576")) << resolution;
  EXPECT_TRUE(mentions(errorOfOpening(scene(), {.voxelSize = -1}), "voxel size"));
  const auto grid = grids();
  EXPECT_TRUE(mentions(errorOfOpening(grid, {}), "sphere"));
  EXPECT_TRUE(mentions(errorOfOpening(grid, {.grid = "sphere", .sigmaGrid = "sphere"}), "itself"));
  EXPECT_TRUE(mentions(errorOfOpening(grid, {.grid = "sphere", .weightGrid = ""}), "weight grid is empty"));
  EXPECT_TRUE(mentions(errorOfOpening(grid, {.grid = "sphere", .weightGrid = "none"}), "none"));
}

TEST(PlaneOriginName, IsThatOfReports) {
  EXPECT_EQ(planeOriginName(PlaneOrigin::kGradient), "gradient");
  EXPECT_EQ(planeOriginName(PlaneOrigin::kDistance), "distance");
  EXPECT_EQ(planeOriginName(PlaneOrigin::kFunction), "function");
}

}  // namespace
}  // namespace pdc
