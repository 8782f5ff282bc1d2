// What the default makes of the kinds of surfaces that people mesh, of which no constant was chosen with these; see
// docs/defaults.md.

#include "eval/kinds.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <stdexcept>

#include "eval/inputs.h"
#include "eval/surface_figures.h"
#include "pdc/extract/contour.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

constexpr unsigned kSeed = 700000;

const eval::Kind& kind(const std::string& name) {
  static const std::vector<eval::Kind> all = eval::makeKinds(true);
  const auto it = std::find_if(all.begin(), all.end(), [&](const eval::Kind& k) { return k.shape.name == name; });
  if (it == all.end()) throw std::invalid_argument(name);
  return *it;
}

/// A kind as a grid, in one pose.
struct Sampled {
  Sampled(const std::string& name, const std::string& input, double noise, unsigned pose = 0)
      : posed(kind(name), eval::randomPose(kSeed + pose, kind(name).size), pose),
        grid(eval::withNoise(eval::makeClean(
                                 input, [this](const Vec3d& p) { return posed.distance(p); }, kind(name).reach),
                             noise, false, kSeed + pose)) {}

  [[nodiscard]] eval::SurfaceFigures figures(const ContourOptions& options = {}, HermiteMode mode = HermiteMode::kAuto,
                                             ContourReport* report = nullptr) const {
    const Mesh mesh = contour(GridSource(grid.grid, {.iso = grid.iso, .hermite = mode}), options, report);
    EXPECT_TRUE(selfIntersections(mesh).pairs.empty());
    return posed.measure(mesh);
  }

  eval::PosedKind posed;
  eval::GridInput grid;
};

class KindsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { openvdb::initialize(); }
};

eval::SurfaceFigures pooled(const std::string& name, double noise, const ContourOptions& options = {},
                            HermiteMode mode = HermiteMode::kAuto) {
  std::vector<eval::SurfaceFigures> all;
  for (unsigned pose = 0; pose < 6; ++pose)
    all.push_back(Sampled(name, "level_set", noise, pose).figures(options, mode));
  return eval::pool(all);
}

TEST_F(KindsTest, SpheresOfFewVoxelsAreRound) {
  for (const char* name : {"sphere_1.7", "sphere_2.3", "sphere_2.8"}) {
    const eval::SurfaceFigures own = pooled(name, 0),
                               papers = pooled(name, 0, {.sigmaNormal = kPapersSigmaNormal}, HermiteMode::kGradient);
    EXPECT_LT(own.surfaceRms, 0.88 * papers.surfaceRms) << name;
    EXPECT_LT(own.normalMax, 25) << name;
    EXPECT_EQ(own.turned, 0) << name;
  }
}

TEST_F(KindsTest, NoiseTurnsHardlyAFaceOfASphereOrATorus) {
  const eval::SurfaceFigures ball = pooled("sphere_4.5", 0.05);
  EXPECT_LT(ball.turned, ball.triangles / 500);
  EXPECT_LT(ball.normalRms, 5);
  const eval::SurfaceFigures torus = Sampled("torus_4", "level_set", 0.05).figures();
  EXPECT_LT(torus.normalRms, 5.5);
  EXPECT_LT(torus.normalP99, 15);
}

TEST_F(KindsTest, CreasesAreWhereThereAreCreases) {
  ContourReport report;
  static_cast<void>(Sampled("sphere_2.3", "level_set", 0).figures({}, HermiteMode::kAuto, &report));
  EXPECT_EQ(report.creasePatches, 0);
  static_cast<void>(Sampled("film_3", "level_set", 0).figures({}, HermiteMode::kAuto, &report));
  EXPECT_EQ(report.creasePatches, 0);
  const eval::SurfaceFigures slab = Sampled("slab", "level_set", 0).figures({}, HermiteMode::kAuto, &report);
  EXPECT_GT(report.creasePatches, 200);
  EXPECT_LT(slab.edgeRms, 0.01);
}

TEST_F(KindsTest, TheNoiseOfNormalsIsFound) {
  for (const char* name : {"torus_4", "noise_18", "sphere_8"})
    for (const double noise : {0.05, 0.1, 0.2}) {
      const Sampled fog(name, "fog", noise);
      ContourReport report;
      static_cast<void>(fog.figures({}, HermiteMode::kAuto, &report));
      const double truth = eval::trueNormalNoise(GridSource(fog.grid.grid, {.iso = fog.grid.iso}), fog.posed);
      EXPECT_NEAR(report.normalNoise / truth, 1, 0.3) << name << ' ' << noise;
    }
}

TEST_F(KindsTest, TheNoiseOfDistancesIsFound) {
  for (const char* name : {"torus_4", "film_3", "slab", "sphere_8"})
    for (const double noise : {0.02, 0.05, 0.1, 0.2}) {
      const GridSource source(Sampled(name, "level_set", noise).grid.grid);
      EXPECT_NEAR(source.valueNoise() / noise, 1, 0.3) << name << ' ' << noise;
    }
}

TEST_F(KindsTest, RoughFogsStayCalm) {
  ContourReport report;
  const Sampled rough("noise_6", "fog", 0.2);
  static_cast<void>(rough.figures({}, HermiteMode::kAuto, &report));
  EXPECT_GT(report.medianSigmaNormal, 0.4);
  EXPECT_EQ(report.uncertified, 0);
}

}  // namespace
}  // namespace pdc
