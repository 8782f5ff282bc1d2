#include "io/open_volume.h"

#include <cmath>

#include "folders.h"
#include "io/volume/test_volumes.h"
#include "pdc/extract/contour.h"
#include "pdc/io/open_input.h"
#include "pdc/mesh/mesh_report.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

/// Single-precision values of a function of the index, x running fastest.
template <typename Function>
std::string floatsOf(int side, const Function& f) {
  std::string bytes;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) bytes += bytesOf(static_cast<float>(f(Vec3d(x, y, z))));
  return bytes;
}

MeshReport reportOf(const fs::path& path, const InputOptions& options = {}) {
  return analyze(contour(*openInput(path, options).source, {.sigmaNormal = 0.05}));
}

bool isSound(const MeshReport& r) {
  return r.boundaryEdges == 0 && r.nonManifoldEdges == 0 && r.nonManifoldVertices == 0 && r.misorientedEdges == 0;
}

TEST(OpenVolume, APlaneLiesWhereMirroredAndShearedMapsSay) {
  const TemporaryFolder folder;
  constexpr int kSide = 16;
  const Vec3d normal{0.6, 0.64, 0.48};
  const auto plane = [&](const Vec3d& i) { return dot(normal, i) - 11.25; };
  NiftiFile file;
  file.dim = {kSide, kSide, kSide};
  file.datatype = 16;
  file.sformCode = 1;
  for (const std::array<double, 12>& sform : {std::array<double, 12>{2, 0, 0, 10, 0, 3, 0, -20, 0, 0, 4, 30},
                                              {-1, 0.25, 0, 5, 0.5, 1, 0.125, 6, 0, 0, 2, 7},
                                              {0, -2, 0, 1, 2, 0, 0, 2, 0, 0, 2, 3}}) {
    file.sform = sform;
    writeContents(folder / "a.nii", file.header() + floatsOf(kSide, plane));
    const Input input = openInput(folder / "a.nii", {.iso = 0, .open = true, .gridClass = GridClass::kLevelSet});
    const Mesh mesh = contour(*input.source, {.sigmaNormal = 0.0});
    ASSERT_GT(mesh.positions.size(), 100u);
    const DenseVolume volume = readVolume(folder / "a.nii");
    const Mat3d toIndex = inverse(volume.linear);
    for (const Vec3f& p : mesh.positions) {
      const Vec3d index = toIndex * (mesh.origin + vecCast<double>(p) - volume.translation);
      ASSERT_NEAR(plane(index), 0, 1e-5);
    }
    ASSERT_EQ(input.volume->space, "RAS");
    ASSERT_EQ(input.volume->unit, "mm");
  }
}

TEST(OpenVolume, MirroredVolumesFaceOutwards) {
  const TemporaryFolder folder;
  constexpr int kSide = 12;
  NiftiFile file;
  file.dim = {kSide, kSide, kSide};
  file.sformCode = 1;
  for (const double x : {1.0, -1.0}) {
    file.sform = {x, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    writeContents(folder / "a.nii", file.header() + ballBytes(kSide));
    const MeshReport report = reportOf(folder / "a.nii", {.iso = 100});
    EXPECT_TRUE(isSound(report));
    EXPECT_NEAR(report.volume, 4.0 / 3 * 3.14159 * 64, 15);
  }
}

TEST(OpenVolume, AllFormatsOfABallGiveOneMesh) {
  const TemporaryFolder folder;
  constexpr int kSide = 14;
  for (const auto& [name, content] : ballFiles(kSide)) {
    writeContents(folder / name, content);
    const Input input = openInput(folder / name, {.iso = 100});
    const MeshReport report = analyze(contour(*input.source));
    EXPECT_TRUE(isSound(report)) << name;
    EXPECT_EQ(report.eulerNumber, 2) << name;
    EXPECT_EQ(report.vertices, reportOf(folder / "a.nii", {.iso = 100}).vertices) << name;
  }
}

TEST(OpenVolume, OtsusThresholdIsBetweenTheClasses) {
  const TemporaryFolder folder;
  constexpr int kSide = 16;
  const auto halves = [](const Vec3d& i) { return i.x < 8 ? 10.0 : 30.0; };
  const RawVolume raw{.size = {kSide, kSide, kSide}, .type = ScalarType::kFloat32};
  writeContents(folder / "a.raw", floatsOf(kSide, halves));
  const Input input = openInput(folder / "a.raw", {.volume = {.raw = raw}, .isoFromOtsu = true});
  EXPECT_NEAR(input.iso, 20, 0.1);
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.raw", {.iso = 1, .volume = {.raw = raw}, .isoFromOtsu = true})),
               Error);
  writeContents(folder / "a.raw", floatsOf(kSide, [](const Vec3d&) { return 1.0; }));
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.raw", {.volume = {.raw = raw}, .isoFromOtsu = true})), Error);
}

TEST(OpenVolume, StepsWorkOnVolumes) {
  const TemporaryFolder folder;
  constexpr int kSide = 20;
  NiftiFile file;
  file.dim = {kSide, kSide, kSide};
  file.sformCode = 1;
  file.sform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  writeContents(folder / "a.nii", file.header() + ballBytes(kSide));
  InputOptions options{.iso = 100};
  options.steps.clip = ClipOptions{.box = {{-1, -1, -1}, {9.5, 30, 30}}};
  const Input input = openInput(folder / "a.nii", options);
  EXPECT_EQ(input.steps.size(), 1u);
  EXPECT_EQ(input.volume->space, "RAS");
  const MeshReport report = analyze(contour(*input.source, {.sigmaNormal = 0.05}));
  EXPECT_TRUE(isSound(report));
  EXPECT_NEAR(report.bounds.hi.x, 9.5, 0.6);
}

TEST(OpenVolume, OptionsOfOtherInputsAreRefused) {
  const TemporaryFolder folder;
  writeContents(folder / "a.nii", ballFiles(10)[0].second);
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.nii", {.sigmaGrid = "s"})), Error);
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.nii", {.attributes = {"s"}})), Error);
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.nii", {.voxelSize = 1})), Error);
  writeContents(folder / "a.yaml",
                "voxel_size: 0.25\nbox: [[-1, -1, -1], [1, 1, 1]]\nshape: {sphere: {radius: 0.5}}\n");
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.yaml", {.volume = {.channel = 1}})), Error);
  EXPECT_THROW(static_cast<void>(openInput(folder / "a.yaml", {.isoFromOtsu = true})), Error);
}

struct RealVolume {
  const char* name;
  const char* space;
  double iso;
};

class OpenRealVolume : public testing::TestWithParam<RealVolume> {};

TEST_P(OpenRealVolume, GivesAClosedManifoldMesh) {
  const fs::path path = test::dataFolder() / "volume" / GetParam().name;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is not there";
  const Input input = openInput(path, {.iso = GetParam().iso});
  EXPECT_EQ(input.volume->space, GetParam().space);
  const MeshReport report = analyze(contour(*input.source, {.sigmaNormal = 0.05}));
  EXPECT_TRUE(isSound(report));
  EXPECT_GT(report.vertices, 5000u);
  EXPECT_GT(report.volume, 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, OpenRealVolume,
    testing::Values(RealVolume{"engine_256x256x128_u8.nii.gz", "RAS", 100}, RealVolume{"HeadMRVolume.mhd", "LPS", 40},
                    RealVolume{"label_skull_160x232x160_u8.nrrd", "LPS", 0.5}, RealVolume{"microct_bone.nrrd", "", 100},
                    RealVolume{"mri_t1_stroke_124x160x140_u8.nii.gz", "RAS", 60},
                    RealVolume{"neghip_u8.mha", "LPS", 60}, RealVolume{"silicium_u8.mha", "LPS", 120},
                    RealVolume{"skull_2.9_64_f32.inr", "", 2.9}, RealVolume{"tooth.nhdr", "", 500}),
    [](const auto& parameter) {
      std::string name = parameter.param.name;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

}  // namespace
}  // namespace pdc
