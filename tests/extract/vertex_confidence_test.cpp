#include "extract/vertex_confidence.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/ChangeBackground.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <string_view>

#include "eval/inputs.h"
#include "eval/metrics.h"
#include "eval/shapes.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"
#include "pdc/simplify/decimate.h"

namespace pdc {
namespace {

constexpr double kSize = 14;  ///< Half size of the solids, in voxels.
constexpr unsigned kPose = 910000;

const ContourOptions kRated{.confidence = true, .ranks = true};

FieldSource turnedBox() {
  return FieldSource(rotate(box({}, {0.45, 0.45, 0.45}), {1, 2, 3}, 25),
                     {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 1.0 / 16});
}

class VertexConfidence : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

/// In the box's own frame: on how many of its planes a point lies.
int planesThrough(const Vec3f& p) {
  const FieldPtr slabs[3] = {box({}, {0.45, 9, 9}), box({}, {9, 0.45, 9}), box({}, {9, 9, 0.45})};
  int planes = 0;
  for (const FieldPtr& slab : slabs) {
    double value = 0;
    const Vec3d x = vecCast<double>(p);
    rotate(slab, {1, 2, 3}, 25)->values({&x.x, &x.y, &x.z, 1}, &value);
    planes += std::abs(value) < 1e-4;
  }
  return planes;
}

TEST_F(VertexConfidence, RanksOfABoxAreItsFacesEdgesAndCorners) {
  const Mesh mesh = contour(turnedBox(), {.sigmaNormal = 0, .placement = Placement::kFree, .ranks = true});
  const auto rank = mesh.values<std::uint8_t>("rank");
  ASSERT_EQ(rank.size(), mesh.positions.size());
  EXPECT_EQ(mesh.properties.size(), 1u);
  std::array<int, 4> ranks{};
  for (std::size_t i = 0; i < rank.size(); ++i) {
    ASSERT_LE(rank[i], 3);
    ++ranks[rank[i]];
    EXPECT_GE(planesThrough(mesh.positions[i]), rank[i]) << i;
  }
  EXPECT_EQ(ranks[0], 0);
  EXPECT_GE(ranks[3], 8);
  EXPECT_GE(ranks[2], 12 * 12);
  EXPECT_GE(ranks[1], 6 * 10 * 10);
}

TEST_F(VertexConfidence, ExactPlanesHaveFullConfidence) {
  const Mesh mesh = contour(turnedBox(), {.sigmaNormal = 0, .placement = Placement::kFree, .confidence = true});
  const auto confidence = mesh.values<float>("confidence");
  ASSERT_EQ(confidence.size(), mesh.positions.size());
  ASSERT_EQ(mesh.values<float>("sigma").size(), mesh.positions.size());
  EXPECT_EQ(mesh.properties.size(), 2u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (planesThrough(mesh.positions[i]) == 1) {
      ASSERT_GT(confidence[i], 0.999F) << i;
      ASSERT_LT(mesh.values<float>("sigma")[i], 1e-6F) << i;
    }
}

TEST_F(VertexConfidence, RanksOfALevelSetAreThoseOfItsCreases) {
  const auto shapes = eval::makeShapes(kSize);
  const auto hexagon =
      std::find_if(shapes.begin(), shapes.end(), [](const eval::Shape& s) { return s.name == "hexagon"; });
  const eval::Pose pose = eval::randomPose(kPose, kSize);
  const Mesh mesh = contour(GridSource(eval::makeGrid("exact", *hexagon, pose, 0, 1).grid), kRated);
  const auto ranks = mesh.values<std::uint8_t>("rank");
  for (const Vec3d& corner : hexagon->corners) {
    int nearest = 0;
    double best = 2;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (const double d = length(vecCast<double>(mesh.positions[i]) - pose.toWorld(corner)); d < best) {
        best = d;
        nearest = ranks[i];
      }
    EXPECT_GE(nearest, 2);
  }
  EXPECT_GE(std::count(ranks.begin(), ranks.end(), 3), 8);
}

TEST_F(VertexConfidence, AskingChangesNothingElseAndThreadsDoNotMatter) {
  const auto shapes = eval::makeShapes(kSize);
  const eval::GridInput input = eval::makeGrid("exact", shapes[2], eval::randomPose(kPose, kSize), 0.1, 1);
  const GridSource source(input.grid);
  ContourReport report;
  const Mesh plain = contour(source, {}, &report), rated = contour(source, kRated);
  EXPECT_GT(report.fans, 0u);  // Whose vertices are rated too.
  EXPECT_EQ(rated.positions, plain.positions);
  EXPECT_EQ(rated.quads, plain.quads);
  EXPECT_EQ(rated.triangles, plain.triangles);
  ASSERT_EQ(rated.values<float>("confidence").size(), rated.positions.size());
  ASSERT_EQ(rated.values<std::uint8_t>("rank").size(), rated.positions.size());
  for (const float c : rated.values<float>("confidence")) ASSERT_TRUE(c > 0 && c <= 1) << c;
  for (const int threads : {1, 3}) {
    const Mesh again =
        contour(source, {.triangles = threads == 3, .confidence = true, .ranks = true, .threads = threads});
    EXPECT_EQ(again.properties, rated.properties);
  }
}

/// Over the vertices of solids that no constant was chosen with. Planes from distances share their samples with those
/// of neighbours: their errors are alike, so that less can be told of them.
TEST_F(VertexConfidence, ConfidenceFollowsTheTrueErrorOfNoisyShapes) {
  for (const auto& [mode, least] : {std::pair{HermiteMode::kGradient, 0.55}, {HermiteMode::kDistance, 0.5}}) {
    std::vector<double> doubt, error;
    for (const eval::Shape& shape : eval::makeShapes(kSize)) {
      if (!shape.heldOut) continue;
      for (const double noise : {0.02, 0.05, 0.1}) {
        const eval::Pose pose = eval::randomPose(kPose, kSize);
        const GridSource source(eval::makeGrid("exact", shape, pose, noise, 1).grid, {.hermite = mode});
        const Mesh mesh = contour(source, {.confidence = true});
        for (const float c : mesh.values<float>("confidence")) doubt.push_back(-c);
        const std::vector<double> errors = eval::vertexErrors(mesh, shape, pose);
        error.insert(error.end(), errors.begin(), errors.end());
      }
    }
    EXPECT_GT(eval::rankCorrelation(doubt, error), least);
  }
}

double rootMeanSquare(const auto& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Along the normals of smooth shapes and of those with creases, planes from gradients and from distances.
TEST_F(VertexConfidence, SigmaIsNearTheTrueError) {
  const auto shapes = eval::makeShapes(kSize);
  for (const HermiteMode mode : {HermiteMode::kGradient, HermiteMode::kDistance})
    for (const char* const name : {"sphere", "box", "cylinder"})
      for (const double noise : {0.02, 0.05, 0.1, 0.2}) {
        const auto shape = std::find_if(shapes.begin(), shapes.end(), [&](const auto& s) { return s.name == name; });
        const eval::Pose pose = eval::randomPose(kPose, kSize);
        const GridSource source(eval::makeGrid("exact", *shape, pose, noise, 1).grid, {.hermite = mode});
        const Mesh mesh = contour(source, {.confidence = true});
        const double ratio =
            rootMeanSquare(mesh.values<float>("sigma")) / rootMeanSquare(eval::vertexErrors(mesh, *shape, pose));
        EXPECT_GT(ratio, 0.55) << name << noise;
        EXPECT_LT(ratio, 1.3) << name << noise;
      }
}

TEST_F(VertexConfidence, SigmaIsALengthInWorldUnits) {
  const auto shapes = eval::makeShapes(kSize);
  const auto sphere =
      std::find_if(shapes.begin(), shapes.end(), [](const eval::Shape& s) { return s.name == "sphere"; });
  const eval::Pose pose = eval::randomPose(kPose, kSize);
  const auto sigmas = [&](double noise, double scale) {
    const openvdb::FloatGrid::Ptr grid = eval::makeGrid("exact", *sphere, pose, noise, 1).grid;
    for (auto value = grid->beginValueAll(); value; ++value) value.setValue(static_cast<float>(scale * *value));
    openvdb::tools::changeBackground(grid->tree(), static_cast<float>(scale * grid->background()));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(scale));
    const Mesh mesh = contour(GridSource(grid), {.confidence = true});
    const auto found = mesh.values<float>("sigma");
    return std::vector<double>(found.begin(), found.end());
  };
  EXPECT_LT(rootMeanSquare(sigmas(0, 1)), 0.005);
  const std::vector<double> one = sigmas(0.05, 1), four = sigmas(0.05, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(four[i], 4 * one[i], 4e-4 * one[i]) << i;
}

// Noise of the distances grows along x from 0 to half a voxel.
TEST_F(VertexConfidence, SigmaKeepsDecimationOutOfNoise) {
  const auto shapes = eval::makeShapes(kSize);
  const eval::Pose pose = eval::randomPose(kPose, kSize);
  for (const char* const name : {"sphere", "box", "cylinder"}) {
    const auto shape = std::find_if(shapes.begin(), shapes.end(), [&](const auto& s) { return s.name == name; });
    const Mesh mesh = contour(GridSource(eval::makeGradedGrid(*shape, pose, 0.5, 1).grid), {.confidence = true});
    const auto noisyVertices = [&](const std::string& property) {
      const Mesh fewer = decimate(mesh, {.ratio = 0.2, .sigmaProperty = property});
      const auto isNoisy = [&](const Vec3f& p) { return p.x > pose.offset.x + kSize / 3; };
      return std::count_if(fewer.positions.begin(), fewer.positions.end(), isNoisy);
    };
    EXPECT_LT(static_cast<double>(noisyVertices("sigma")), 0.9 * static_cast<double>(noisyVertices(""))) << name;
  }
}

// The last blocks are sampled, but the neighbours of the vertices are still to be looked at.
TEST_F(VertexConfidence, StopsAfterSamplingToo) {
  const FieldSource source(sphere({}, 0.8), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 0.05});
  std::atomic<bool> stop = false;
  const auto progress = [&stop](const char* stage, double share) {
    if (std::string_view(stage) == "confidence" && share == 1) stop = true;
  };
  EXPECT_THROW(static_cast<void>(contour(source, {.confidence = true}, nullptr, {.progress = progress, .stop = &stop})),
               Cancelled);
}

}  // namespace
}  // namespace pdc
