#include "pdc/extract/contour.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <string>

#include "extract/topology/block_topology.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Box kBox{{-1, -1, -1}, {1, 1, 1}};

FieldSource source(FieldPtr field, int resolution) {
  return FieldSource(std::move(field), {.box = kBox, .voxelSize = 2.0 / resolution});
}

/// A cube of half size 0.45 turned so that nothing is aligned with the lattice.
FieldPtr rotatedBox() { return rotate(box({}, {0.45, 0.45, 0.45}), {1, 2, 3}, 25); }

double distanceToTriangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d00 = dot(ab, ab), d01 = dot(ab, ac), d11 = dot(ac, ac), d20 = dot(ap, ab), d21 = dot(ap, ac);
  const double det = d00 * d11 - d01 * d01;
  if (det > 0) {
    const double v = (d11 * d20 - d01 * d21) / det, w = (d00 * d21 - d01 * d20) / det;
    if (v >= 0 && w >= 0 && v + w <= 1) return length(ap - ab * v - ac * w);
  }
  const auto toSegment = [&](const Vec3d& s, const Vec3d& e) {
    const Vec3d d = e - s;
    const double l = dot(d, d), t = l > 0 ? std::clamp(dot(p - s, d) / l, 0.0, 1.0) : 0.0;
    return length(p - s - d * t);
  };
  return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
}

double distanceToMesh(const Vec3d& p, const Mesh& mesh, double reach) {
  double best = kInfinity;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = vecCast<double>(mesh.positions[t[0]]);
    if (length(p - a) > reach) continue;
    best = std::min(
        best, distanceToTriangle(p, a, vecCast<double>(mesh.positions[t[1]]), vecCast<double>(mesh.positions[t[2]])));
  }
  return best;
}

// Corners and edges lie on the surface to a hundredth of a voxel, although no vertex knows more than its own cell.
TEST(Contour, FreePlacementReachesCornersAndEdges) {
  constexpr int kResolution = 64;
  constexpr double kVoxel = 2.0 / kResolution;
  const Mesh mesh = contour(source(rotatedBox(), kResolution),
                            {.sigmaNormal = 0.01, .placement = Placement::kFree, .triangles = true});
  const Mat3d R = rotation({1, 2, 3}, 25);
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i <= 100; ++i) {
        Vec3d p;
        p[axis] = 0.45 * (i / 50.0 - 1);
        p[(axis + 1) % 3] = side & 1 ? 0.45 : -0.45;
        p[(axis + 2) % 3] = side & 2 ? 0.45 : -0.45;
        worst = std::max(worst, distanceToMesh(R * p, mesh, 6 * kVoxel));
      }
  EXPECT_LT(worst / kVoxel, 0.01);
}

TEST(Contour, SphereConvergesWithSecondOrder) {
  double previous = 0;
  for (const int resolution : {16, 32, 64, 128}) {
    const Mesh mesh = contour(source(sphere({0.01, 0.02, 0.03}, 0.8), resolution));
    double sum = 0;
    for (const Vec3f& p : mesh.positions)
      sum += std::pow(length(vecCast<double>(p) - Vec3d{0.01, 0.02, 0.03}) - 0.8, 2);
    const double rms = std::sqrt(sum / static_cast<double>(mesh.positions.size()));
    EXPECT_TRUE(previous == 0 || previous / rms > 3.6) << resolution;
    previous = rms;
  }
}

TEST(Contour, InfiniteNoiseIsSmootherThanNone) {
  // The mass points of a cube's cells cut its corners off; the classical quadric does not.
  const auto mesh = [&](double sigma) {
    return contour(source(rotatedBox(), 32), {.sigmaNormal = sigma, .placement = Placement::kFree});
  };
  const double exact = std::pow(0.9, 3);
  const Mesh smooth = mesh(kInfinity), nearlySmooth = mesh(1e4);
  EXPECT_NEAR(analyze(mesh(0)).volume / exact, 1, 1e-3);
  EXPECT_LT(analyze(smooth).volume / exact, 0.995);
  for (std::size_t i = 0; i < smooth.positions.size(); ++i)
    ASSERT_LT(length(smooth.positions[i] - nearlySmooth.positions[i]), 1e-6F);
}

TEST(Contour, SameBytesForAnyNumberOfThreads) {
  const FieldPtr field = subtract({rotatedBox(), sphere({0.3, 0.3, 0.3}, 0.4)});
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const FieldSource input = source(field, 100);
  const Mesh reference = contour(input, {.normals = true, .threads = 1});
  for (const int threads : {2, 3, 8})
    for (int run = 0; run < 5; ++run) {
      const Mesh mesh = contour(input, {.normals = true, .threads = threads});
      ASSERT_EQ(mesh.quads, reference.quads);
      ASSERT_EQ(mesh.positions, reference.positions);
      ASSERT_EQ(mesh.normals, reference.normals);
    }
}

TEST(Contour, NormalsPointOutwards) {
  const Mesh mesh = contour(source(sphere({}, 0.7), 40), {.normals = true});
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vec3f p = mesh.positions[i];
    EXPECT_GT(dot(mesh.normals[i], p * (1 / length(p))), 0.999F);
  }
}

TEST(Contour, ReportCountsWhatHappened) {
  ContourReport cell, free;
  const Mesh mesh = contour(source(rotatedBox(), 32), {.placement = Placement::kCell}, &cell);
  (void)contour(source(rotatedBox(), 32), {.placement = Placement::kFree}, &free);
  EXPECT_EQ(cell.crossings, mesh.quads.size());
  EXPECT_GT(cell.outOfCell, 0u);
  EXPECT_EQ(cell.outOfCell, free.outOfCell);
  EXPECT_GE(cell.clamped, cell.outOfCell);
  EXPECT_LT(free.clamped, cell.clamped / 10);
  EXPECT_EQ(cell.crossingsWithoutNormal, 0u);
  EXPECT_EQ(cell.boundaryEdges, 0u);
}

TEST(Contour, RejectsWhatMakesNoSense) {
  const FieldSource input = source(sphere({}, 0.5), 16);
  EXPECT_THROW((void)contour(input, {.sigmaNormal = -0.1}), std::invalid_argument);
  EXPECT_THROW((void)contour(input, {.sigmaNormal = NAN}), std::invalid_argument);
  EXPECT_THROW((void)contour(input, {.threads = -1}), std::invalid_argument);
}

TEST(Contour, RefusesMoreVerticesThanIndicesCanName) {
  EXPECT_NO_THROW(detail::checkVertexCount(std::uint64_t{1} << 32));
  EXPECT_THROW(detail::checkVertexCount((std::uint64_t{1} << 32) + 1), Error);
}

TEST(Contour, StopsWhenAsked) {
  std::atomic<bool> stop{true};
  const Monitor monitor{.progress = {}, .stop = &stop};
  EXPECT_THROW((void)contour(source(sphere({}, 0.5), 64), {}, nullptr, monitor), Cancelled);
  // In the middle of each stage.
  for (const std::string stage : {"count", "contour"}) {
    stop = false;
    const Monitor late{.progress = [&](const char* name, double) { stop = stop || name == stage; }, .stop = &stop};
    EXPECT_THROW((void)contour(source(sphere({}, 0.9), 200), {}, nullptr, late), Cancelled) << stage;
  }
}

TEST(Contour, ProgressReachesTheEndOfEveryStage) {
  std::mutex mutex;
  std::set<std::string> finished;
  const Monitor monitor{.progress = [&](const char* stage, double share) {
    ASSERT_GE(share, 0);
    ASSERT_LE(share, 1);
    const std::lock_guard lock(mutex);
    if (share == 1) finished.insert(stage);
  }};
  (void)contour(source(sphere({}, 0.5), 64), {}, nullptr, monitor);
  for (const char* stage : {"count", "contour"}) EXPECT_TRUE(finished.contains(stage)) << stage;
}

TEST(Contour, AnEmptySourceGivesAnEmptyMesh) {
  const Mesh mesh = contour(source(sphere({5, 5, 5}, 0.5), 16));
  EXPECT_TRUE(mesh.empty());
  EXPECT_TRUE(mesh.positions.empty());
}

}  // namespace
}  // namespace pdc
