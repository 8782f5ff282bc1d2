#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "folders.h"
#include "pdc/extract/contour.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

std::vector<std::filesystem::path> sceneFiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder() / "scenes"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string sceneName(const testing::TestParamInfo<std::filesystem::path>& info) { return info.param.stem().string(); }

class SceneTest : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(SceneTest, GivesTheAnswersItStates) {
  const Scene scene = readScene(GetParam());
  const FieldSource source(scene.field, {.box = scene.box, .voxelSize = scene.voxelSize, .iso = scene.iso});
  for (const Placement placement : {Placement::kCell, Placement::kFree}) {
    ContourReport counts;
    const Mesh mesh =
        contour(source, {.sigmaNormal = scene.sigmaNormal.value_or(0.05), .placement = placement}, &counts);
    const MeshReport r = analyze(mesh);
    EXPECT_GT(r.quads, 0u);
    EXPECT_EQ(r.boundaryEdges, 0u);
    EXPECT_EQ(r.nonManifoldEdges, 0u);
    EXPECT_EQ(r.nonManifoldVertices, 0u);
    EXPECT_EQ(r.misorientedEdges, 0u);
    EXPECT_GT(r.volume, 0);
    EXPECT_EQ(counts.crossingsWithoutNormal, 0u);
    const SceneExpectation& expect = scene.expect;
    if (expect.eulerNumber) {
      EXPECT_EQ(r.eulerNumber, *expect.eulerNumber);
    }
    if (expect.area) {
      EXPECT_NEAR(r.area / *expect.area, 1, expect.relativeTolerance);
    }
    if (expect.volume) {
      EXPECT_NEAR(r.volume / *expect.volume, 1, expect.relativeTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SceneTest, testing::ValuesIn(sceneFiles()), sceneName);

}  // namespace
}  // namespace pdc
