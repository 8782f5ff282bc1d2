#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "pdc/error.h"
#include "pdc/extract/contour.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/mesh/mesh_comparison.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

constexpr double kVoxel = 2.0 / 26;
const Box kBox{{-1, -1, -1}, {1, 1, 1}};

struct AdaptiveCase {
  std::string name;
  FieldPtr field;
};

AdaptiveCase caseOf(int i) {
  switch (i) {
    case 0:
      return {"sphere", sphere({}, 0.8)};
    case 1:
      return {"turned_box", rotate(box({}, {0.45, 0.45, 0.45}), {1, 2, 3}, 25)};
    case 2:
      return {"drilled_box", subtract({box({}, {0.6, 0.6, 0.6}), sphere({0, 0, 0.6}, 0.4)})};
    case 3:
      return {"torus", torus({}, {0, 0, 1}, 0.6, 0.25)};
    default:
      return {"noise", subtract({sphere({}, 0.85), simplexNoise({.octaves = 2, .frequency = 2})})};
  }
}

Mesh contourOf(const FieldPtr& field, const ContourOptions& options, ContourReport* report = nullptr) {
  return contour(FieldSource(field, {.box = kBox, .voxelSize = kVoxel}), options, report);
}

class Adaptive : public testing::TestWithParam<int> {};

TEST_P(Adaptive, StaysWithinTheDistanceAndSound) {
  const FieldPtr field = caseOf(GetParam()).field;
  const Mesh full = contourOf(field, {});
  for (const double voxels : {0.05, 0.25}) {
    ContourReport report;
    const Mesh mesh = contourOf(field, {.adaptive = voxels * kVoxel}, &report);
    const MeshComparison c = compareMeshes(mesh, full, {.samples = 100'000});
    EXPECT_LE(std::max(c.toReference.largest, c.fromReference.largest), voxels * kVoxel * (1 + 1e-5));
    EXPECT_LE(report.adaptedDistance, voxels * kVoxel * (1 + 1e-5));
    EXPECT_EQ(report.trianglesBefore, 2 * full.quads.size() + full.triangles.size());
    EXPECT_EQ(selfIntersections(mesh).pairs.size(), 0u);
    const MeshReport facts = analyze(mesh), before = analyze(full);
    EXPECT_EQ(facts.eulerNumber, before.eulerNumber);
    EXPECT_EQ(facts.components, before.components);
    EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.nonManifoldVertices + facts.misorientedEdges, 0u);
    // Noise has few simple places.
    EXPECT_LT(2 * mesh.quads.size() + mesh.triangles.size(), report.trianglesBefore / (GetParam() == 4 ? 1 : 2));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Adaptive, testing::Range(0, 5),
                         [](const auto& shape) { return caseOf(shape.param).name; });

TEST(AdaptiveContour, LeavesTheFacesOfABox) {
  const FieldPtr cube = caseOf(1).field;
  const Mesh mesh = contourOf(cube, {.adaptive = 0.05 * kVoxel});
  EXPECT_EQ(mesh.triangles.size() + 2 * mesh.quads.size(), 12u);
  // Corners stay where they were, and not only within the distance.
  for (const Vec3f& p : mesh.positions) EXPECT_NEAR(length(vecCast<double>(p)), 0.45 * std::sqrt(3.0), 0.01 * kVoxel);
}

TEST(AdaptiveContour, KeepsQuadsWhereNothingWasCollapsed) {
  const FieldPtr rough = caseOf(4).field;
  const Mesh full = contourOf(rough, {});
  const ContourOptions options{.adaptive = 0.01 * kVoxel};
  const Mesh mesh = contourOf(rough, options);
  EXPECT_GT(mesh.quads.size(), 100u);
  // Each is one of the full mesh, corner by corner.
  std::set<std::array<float, 12>> before;
  const auto key = [](const Mesh& m, const Quad& q) {
    std::array<float, 12> all;
    for (int k = 0; k < 12; ++k) all[k] = m.positions[q[k / 3]][k % 3];
    return all;
  };
  for (const Quad& q : full.quads) before.insert(key(full, q));
  for (const Quad& q : mesh.quads) EXPECT_TRUE(before.contains(key(mesh, q)));
  ContourOptions triangles = options;
  triangles.triangles = true;
  const Mesh split = contourOf(rough, triangles);
  EXPECT_TRUE(split.quads.empty());
  EXPECT_EQ(split.triangles.size(), mesh.triangles.size() + 2 * mesh.quads.size());
}

TEST(AdaptiveContour, BringsPropertiesAndNormalsAlong) {
  const Mesh mesh =
      contourOf(caseOf(2).field, {.adaptive = 0.2 * kVoxel, .normals = true, .confidence = true, .ranks = true});
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.values<float>("confidence").size(), mesh.positions.size());
  EXPECT_EQ(mesh.values<std::uint8_t>("rank").size(), mesh.positions.size());
}

/// A tenth where x is below 0.
double tenthOnTheLeft(const Vec3d& p) { return p.x < 0 ? 0.1 : 1; }

std::size_t trianglesOf(const Mesh& mesh) { return 2 * mesh.quads.size() + mesh.triangles.size(); }

/// A mesh of the faces all of whose corners are wanted.
template <typename IsWanted>
Mesh partOf(const Mesh& mesh, const IsWanted& isWanted) {
  Mesh part;
  part.positions = mesh.positions;
  const auto all = [&](const auto& face) {
    return std::all_of(face.begin(), face.end(), [&](std::uint32_t v) { return isWanted(mesh.positions[v]); });
  };
  std::copy_if(mesh.quads.begin(), mesh.quads.end(), std::back_inserter(part.quads), all);
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(part.triangles), all);
  return part;
}

/// The largest distance of a point of a surface to another.
double farthest(const Mesh& from, const Mesh& to) {
  return compareMeshes(from, to, {.samples = 100'000}).toReference.largest;
}

class ScaledAdaptive : public testing::TestWithParam<int> {};

TEST_P(ScaledAdaptive, StaysWithinTheDistanceThatEachPlaceHas) {
  const FieldPtr field = caseOf(GetParam()).field;
  constexpr double kDistance = 0.3 * kVoxel, kFine = 0.1 * kDistance, kRounding = 1 + 1e-5;
  const Mesh full = contourOf(field, {});
  const Mesh mesh = contourOf(field, {.adaptive = kDistance, .adaptiveScale = tenthOnTheLeft});
  const auto left = [](const Vec3f& p) { return p.x < 0; };
  // The nearest of the full mesh may lie on the other side of the border if it is as near as it may be there.
  const auto farLeft = [](const Vec3f& p) { return static_cast<double>(p.x) < -kDistance; };
  EXPECT_LE(farthest(partOf(full, left), mesh), kFine * kRounding);
  EXPECT_LE(farthest(partOf(mesh, farLeft), full), kFine * kRounding);
  EXPECT_LE(farthest(full, mesh), kDistance * kRounding);
  EXPECT_LE(farthest(mesh, full), kDistance * kRounding);
  EXPECT_GT(farthest(mesh, full), 0.9 * kDistance) << "the other half has room";
  const Mesh fine = contourOf(field, {.adaptive = kFine}), coarse = contourOf(field, {.adaptive = kDistance});
  EXPECT_LT(trianglesOf(mesh), 0.9 * static_cast<double>(trianglesOf(fine)));
  EXPECT_GT(trianglesOf(mesh), trianglesOf(coarse));
  EXPECT_EQ(selfIntersections(mesh).pairs.size(), 0u);
  EXPECT_TRUE(mesh.properties.empty());
}

INSTANTIATE_TEST_SUITE_P(Shapes, ScaledAdaptive, testing::Values(0, 2),
                         [](const auto& shape) { return caseOf(shape.param).name; });

/// Adds the vertices that share a face with one that is in.
void addNeighbours(const Mesh& mesh, std::vector<std::uint8_t>& in) {
  const std::vector<std::uint8_t> before = in;
  const auto add = [&](const auto& face) {
    if (std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return before[v] != 0; }))
      for (const std::uint32_t v : face) in[v] = 1;
  };
  for (const Quad& q : mesh.quads) add(q);
  for (const Triangle& t : mesh.triangles) add(t);
}

TEST(AdaptiveContour, LeavesWhatHasNoDistanceAsItIs) {
  const FieldPtr field = caseOf(3).field;
  const Mesh full = contourOf(field, {});
  const auto scale = [](const Vec3d& p) { return p.x < 0 ? 0.0 : 1.0; };
  const Mesh mesh = contourOf(field, {.adaptive = 0.3 * kVoxel, .adaptiveScale = scale});
  const auto left = [](const Vec3f& p) { return p.x < 0; };
  EXPECT_EQ(trianglesOf(partOf(mesh, left)), trianglesOf(partOf(full, left)));
  // Neighbours have it from them, and the triangles of these from them.
  std::vector<std::uint8_t> stays;
  for (const Vec3f& p : full.positions) stays.push_back(left(p));
  addNeighbours(full, stays);
  addNeighbours(contourOf(field, {.triangles = true}), stays);
  std::set<std::array<float, 3>> places;
  for (const Vec3f& p : mesh.positions) places.insert({p.x, p.y, p.z});
  for (std::size_t v = 0; v < stays.size(); ++v) {
    const Vec3f& p = full.positions[v];
    if (stays[v] != 0) {
      EXPECT_TRUE(places.contains({p.x, p.y, p.z})) << v;
    }
  }
  EXPECT_LT(trianglesOf(mesh), 0.7 * static_cast<double>(trianglesOf(full)));
}

TEST(AdaptiveContour, AScaleOfOneChangesNothing) {
  const FieldPtr field = caseOf(2).field;
  const Mesh plain = contourOf(field, {.adaptive = 0.2 * kVoxel});
  const Mesh scaled = contourOf(field, {.adaptive = 0.4 * kVoxel, .adaptiveScale = [](const Vec3d&) { return 0.5; }});
  EXPECT_EQ(plain.positions, scaled.positions);
  EXPECT_EQ(plain.triangles, scaled.triangles);
}

TEST(AdaptiveContour, AsksForScalesInWorldSpace) {
  const Vec3d far{1e6, 0, 0};
  const Box box{far + kBox.lo, far + kBox.hi};
  const auto mesh = [&](const std::function<double(const Vec3d&)>& scale) {
    return contour(FieldSource(translate(sphere({}, 0.8), far), {.box = box, .voxelSize = kVoxel}),
                   {.adaptive = 0.3 * kVoxel, .adaptiveScale = scale, .origin = std::nullopt});
  };
  std::atomic<std::size_t> outside{0};
  const Mesh made = mesh([&](const Vec3d& p) {
    outside += length(p - far) < 0.7 || length(p - far) > 0.9;
    return 1.0;
  });
  ASSERT_NE(made.origin, Vec3d{});
  EXPECT_EQ(outside, 0u);
}

TEST(AdaptiveContour, RefusesScalesThatAreNone) {
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    const auto scale = [bad](const Vec3d& p) { return p.z > 0.7 ? bad : 1; };
    try {
      (void)contourOf(sphere({}, 0.8), {.adaptive = 0.1 * kVoxel, .adaptiveScale = scale});
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("the adaptive scale at ("), std::string::npos) << error.what();
    }
  }
}

TEST(AdaptiveContour, IsTheSameForAnyNumberOfThreads) {
  ContourOptions options{.adaptive = 0.1 * kVoxel, .adaptiveScale = tenthOnTheLeft, .threads = 1};
  const Mesh one = contourOf(caseOf(4).field, options);
  for (const int threads : {3, 8}) {
    options.threads = threads;
    const Mesh other = contourOf(caseOf(4).field, options);
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.quads, other.quads);
  }
}

TEST(AdaptiveContour, KeepsSumsWithTheOriginExact) {
  const FieldPtr far = translate(caseOf(2).field, {1e6, -2e6, 3e6});
  const Box box{{1e6 - 1, -2e6 - 1, 3e6 - 1}, {1e6 + 1, -2e6 + 1, 3e6 + 1}};
  const Mesh mesh = contour(FieldSource(far, {.box = box, .voxelSize = kVoxel}),
                            {.adaptive = 0.2 * kVoxel, .origin = std::nullopt, .exactSums = true});
  ASSERT_NE(mesh.origin, Vec3d{});
  for (const Vec3f& p : mesh.positions)
    for (int k = 0; k < 3; ++k) {
      const double sum = mesh.origin[k] + static_cast<double>(p[k]);
      EXPECT_EQ(sum - mesh.origin[k], static_cast<double>(p[k]));
    }
}

TEST(AdaptiveContour, RefusesWhatItCannotDo) {
  for (const double distance : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW((void)contourOf(sphere({}, 0.5), {.adaptive = distance}), std::invalid_argument) << distance;
  ContourReport report;
  EXPECT_THROW((void)contourOf(sphere({}, 0.5), {.adaptive = 1.0, .quadrics = true}, &report), std::invalid_argument);
}

TEST(AdaptiveContour, OfNothingIsEmpty) { EXPECT_TRUE(contourOf(sphere({5, 5, 5}, 0.5), {.adaptive = 0.1}).empty()); }

TEST(AdaptiveContour, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  const auto show = [&](const char* stage, double) { stop = stop || std::string(stage) == "decimate"; };
  EXPECT_THROW((void)contour(FieldSource(caseOf(4).field, {.box = kBox, .voxelSize = kVoxel}),
                             {.adaptive = 0.2 * kVoxel}, nullptr, {.progress = show, .stop = &stop}),
               Cancelled);
}

}  // namespace
}  // namespace pdc
