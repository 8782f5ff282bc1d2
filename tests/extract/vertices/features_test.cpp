// Creases of solids and poses that no constant of the estimator was chosen with. Figures are in voxels; see
// docs/features.md.

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "eval/inputs.h"
#include "eval/metrics.h"
#include "eval/shapes.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

/// Half size of the solids.
constexpr double kSize = 14;
constexpr unsigned kPose = 900000;

const eval::Shape& shape(const std::string& name) {
  static const std::vector<eval::Shape> all = eval::makeShapes(kSize);
  const auto it = std::find_if(all.begin(), all.end(), [&](const eval::Shape& s) { return s.name == name; });
  if (it == all.end()) throw std::invalid_argument(name);
  return *it;
}

Mesh meshOf(const eval::GridInput& input, HermiteMode mode, Placement placement, int threads = 0) {
  return contour(GridSource(input.grid, {.iso = input.iso, .hermite = mode}),
                 {.placement = placement, .threads = threads});
}

class FeaturesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }

  /// The mean of figures over some poses.
  static eval::Figures figures(const std::string& name, const std::string& input, double noise, HermiteMode mode,
                               Placement placement = Placement::kFree) {
    constexpr unsigned kPoses = 3;
    eval::Figures mean;
    for (unsigned i = kPose; i < kPose + kPoses; ++i) {
      const eval::Pose pose = eval::randomPose(i, kSize);
      const Mesh mesh = meshOf(eval::makeGrid(input, shape(name), pose, noise, i), mode, placement);
      const eval::Figures f = eval::measure(mesh, shape(name), pose);
      for (const auto figure :
           {&eval::Figures::edgeRms, &eval::Figures::cornerMax, &eval::Figures::vertexRms, &eval::Figures::edgeF1})
        mean.*figure += f.*figure / kPoses;
    }
    return mean;
  }
};

TEST_F(FeaturesTest, ExactDistancesKeepEdges) {
  for (const char* name : {"hexagon", "slab", "wedge75", "wedge105", "tube"}) {
    const eval::Figures f = figures(name, "exact", 0, HermiteMode::kAuto);
    EXPECT_LT(f.edgeRms, 0.015) << name;
    EXPECT_GT(f.edgeF1, 0.97) << name;
  }
}

TEST_F(FeaturesTest, GradientsDoNot) {
  EXPECT_GT(figures("hexagon", "exact", 0, HermiteMode::kGradient).edgeRms, 0.05);
}

TEST_F(FeaturesTest, ConcaveEdgesAreKept) {
  EXPECT_LT(figures("bracket", "exact", 0, HermiteMode::kAuto).edgeRms, 0.02);
}

TEST_F(FeaturesTest, HalfPrecisionAndOtherIsovaluesKeepEdges) {
  EXPECT_LT(figures("hexagon", "half", 0, HermiteMode::kAuto).edgeRms, 0.015);
  EXPECT_LT(figures("hexagon", "iso", 0, HermiteMode::kAuto).edgeRms, 0.03);
}

TEST_F(FeaturesTest, RasterisedMeshesKeepEdges) {
  EXPECT_LT(figures("hexagon", "mesh", 0, HermiteMode::kAuto).edgeRms, 0.015);
}

TEST_F(FeaturesTest, NoiseBlursEdgesByAboutAsMuch) {
  const eval::Figures f = figures("hexagon", "exact", 0.02, HermiteMode::kAuto);
  EXPECT_LT(f.edgeRms, 0.025);
  EXPECT_LT(f.vertexRms, figures("hexagon", "exact", 0.02, HermiteMode::kGradient).vertexRms);
}

/// Noise that grows from 0 to 0.2 voxels across the solid, and what single σn make of it.
TEST_F(FeaturesTest, ASigmaGridBeatsEverySingleSigmaInBothHalves) {
  constexpr unsigned kPoses = 20;
  const std::vector<double> sigmas{0.01, 0.05, 0.1, 0.2, 0.5, 1};
  std::vector<eval::Figures> single(sigmas.size());
  eval::Figures known;
  for (unsigned i = kPose; i < kPose + kPoses; ++i) {
    const eval::Pose pose = eval::randomPose(i, kSize);
    const eval::GridInput input = eval::makeGradedGrid(shape("hexagon"), pose, 0.2, i);
    const auto add = [&](const GridSource& source, std::optional<double> sigma, eval::Figures& sum) {
      const Mesh mesh = contour(source, {.sigmaNormal = sigma});
      const eval::Figures f = eval::measure(mesh, shape("hexagon"), pose, eval::Part::kHalves);
      sum.vertexRms += f.vertexRms / kPoses;
      sum.edgeRms += f.edgeRms / kPoses;
    };
    const GridSource plain(input.grid, {.hermite = HermiteMode::kDistance});
    for (std::size_t k = 0; k < sigmas.size(); ++k) add(plain, sigmas[k], single[k]);
    add(GridSource(input.grid, {.hermite = HermiteMode::kDistance, .sigma = input.sigma}), std::nullopt, known);
  }
  for (std::size_t k = 0; k < sigmas.size(); ++k) {
    EXPECT_LT(known.vertexRms, single[k].vertexRms) << sigmas[k];
    EXPECT_LT(known.edgeRms, single[k].edgeRms) << sigmas[k];
  }
}

TEST_F(FeaturesTest, SmoothSurfacesAreNoWorse) {
  EXPECT_LE(figures("sphere", "exact", 0, HermiteMode::kAuto).vertexRms,
            figures("sphere", "exact", 0, HermiteMode::kGradient).vertexRms);
}

TEST_F(FeaturesTest, CertifiedMeshesDoNotIntersectThemselves) {
  for (const char* name : {"hexagon", "star", "tube"}) {
    const eval::Pose pose = eval::randomPose(kPose, kSize);
    const Mesh mesh =
        meshOf(eval::makeGrid("exact", shape(name), pose, 0, 1), HermiteMode::kAuto, Placement::kCertified);
    EXPECT_TRUE(selfIntersections(mesh).pairs.empty()) << name;
    EXPECT_LT(eval::measure(mesh, shape(name), pose).edgeRms, 0.12) << name;
  }
}

TEST_F(FeaturesTest, CertifyingKeepsEdgesOfExactDistances) {
  for (const char* name : {"hexagon", "wedge75", "slab"})
    EXPECT_LT(figures(name, "exact", 0, HermiteMode::kAuto, Placement::kCertified).edgeRms, 0.012) << name;
}

TEST_F(FeaturesTest, ThreadsDoNotMatter) {
  const eval::Pose pose = eval::randomPose(kPose, kSize);
  const eval::GridInput input = eval::makeGrid("exact", shape("star"), pose, 0.02, 1);
  for (const Placement placement : {Placement::kFree, Placement::kCertified}) {
    const Mesh one = meshOf(input, HermiteMode::kAuto, placement, 1),
               three = meshOf(input, HermiteMode::kAuto, placement, 3);
    EXPECT_EQ(one.positions, three.positions);
    EXPECT_EQ(one.quads, three.quads);
    EXPECT_EQ(one.triangles, three.triangles);
  }
}

/// The same solid on a lattice with a voxel of a tenth and turned axes.
TEST_F(FeaturesTest, TransformsDoNotMatter) {
  const eval::Pose pose = eval::randomPose(kPose, kSize);
  const eval::GridInput input = eval::makeGrid("exact", shape("hexagon"), pose, 0, 1);
  const Mesh plain = meshOf(input, HermiteMode::kAuto, Placement::kFree);
  const auto scaled = openvdb::FloatGrid::create(0.1F * input.grid->background());
  scaled->setGridClass(openvdb::GRID_LEVEL_SET);
  scaled->setTree(input.grid->tree().copy());
  scaled->tree().root().setBackground(0.1F * input.grid->background(), false);
  for (auto it = scaled->beginValueAll(); it; ++it) it.setValue(0.1F * *it);
  openvdb::math::Transform::Ptr transform = openvdb::math::Transform::createLinearTransform(0.1);
  transform->postRotate(0.7, openvdb::math::Y_AXIS);
  scaled->setTransform(transform);
  const Mesh turned = meshOf({scaled, 0}, HermiteMode::kAuto, Placement::kFree);
  ASSERT_EQ(plain.positions.size(), turned.positions.size());
  double worst = 0;
  for (std::size_t i = 0; i < plain.positions.size(); ++i) {
    const Vec3f& p = plain.positions[i];
    const openvdb::Vec3d q = transform->indexToWorld(openvdb::Vec3d(p.x, p.y, p.z));
    worst = std::max(worst, length(vecCast<double>(turned.positions[i]) - Vec3d{q.x(), q.y(), q.z()}));
  }
  EXPECT_LT(worst, 0.1 * 0.01);
}

}  // namespace
}  // namespace pdc
