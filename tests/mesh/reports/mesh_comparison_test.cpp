#include "pdc/mesh/mesh_comparison.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "pdc/error.h"
#include "render/shapes.h"

namespace pdc::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Adds the rectangle from x0 to x1 and from 0 to 1 along y.
void addRectangle(Mesh& mesh, float x0, float x1, float z) {
  const auto i = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3f& p : {Vec3f{x0, 0, z}, Vec3f{x1, 0, z}, Vec3f{x1, 1, z}, Vec3f{x0, 1, z}})
    mesh.positions.push_back(p);
  mesh.quads.push_back({i, i + 1, i + 2, i + 3});
}

Mesh square(float z) {
  Mesh mesh;
  addRectangle(mesh, 0, 1, z);
  return mesh;
}

/// z = height - |x| over [-size, size]².
Mesh roof(float size, float height) {
  Mesh mesh;
  for (const float x : {-size, 0.0F, size})
    for (const float y : {-size, size}) mesh.positions.push_back({x, y, height - std::abs(x)});
  mesh.quads = {{0, 2, 3, 1}, {2, 4, 5, 3}};
  return mesh;
}

Mesh scaled(Mesh mesh, float factor) {
  for (Vec3f& p : mesh.positions) p *= factor;
  return mesh;
}

void expectAll(const DistanceFigures& figures, double distance) {
  EXPECT_DOUBLE_EQ(figures.mean, distance);
  EXPECT_DOUBLE_EQ(figures.rms, distance);
  EXPECT_DOUBLE_EQ(figures.p999, distance);
  EXPECT_DOUBLE_EQ(figures.largest, distance);
}

TEST(MeshComparison, ParallelSquaresAreTheirGapApart) {
  const MeshComparison c = compareMeshes(square(0.25F), square(0), {.samples = 1001});
  expectAll(c.toReference, 0.25);
  expectAll(c.fromReference, 0.25);
  EXPECT_EQ(c.toReference.samples, 1001U);
  EXPECT_EQ(c.fromReference.samples, 1001U);
  EXPECT_EQ(c.meanAngle, 0);
  EXPECT_EQ(c.rmsAngle, 0);
  EXPECT_EQ(c.opposedShare, 0);
}

TEST(MeshComparison, SpheresOfTwoRadii) {
  const MeshComparison c = compareMeshes(scaled(sphere(64), 1.5F), sphere(64), {.samples = 20'000});
  for (const DistanceFigures& figures : {c.toReference, c.fromReference}) {
    EXPECT_NEAR(figures.mean, 0.5, 2e-3);
    EXPECT_NEAR(figures.rms, 0.5, 2e-3);
    EXPECT_NEAR(figures.p999, 0.5, 2e-3);
    EXPECT_NEAR(figures.largest, 0.5, 2e-3);
  }
  EXPECT_LT(c.meanAngle, 1);
  EXPECT_LT(c.rmsAngle, 2);
  EXPECT_EQ(c.opposedShare, 0);
}

TEST(MeshComparison, AMeshIsNotApartFromItself) {
  const Mesh mesh = sphere(20);
  const MeshComparison c = compareMeshes(mesh, mesh, {.samples = 10'000});
  EXPECT_LT(c.toReference.largest, 1e-14);
  EXPECT_LT(c.fromReference.largest, 1e-14);
  EXPECT_LT(c.rmsAngle, 1e-12);
}

TEST(MeshComparison, TheLargestDistanceSeesASpikeWithoutArea) {
  Mesh spiked = square(0);
  spiked.positions.push_back({0.5F, 0.5F, 7});
  spiked.triangles = {{0, 4, 0}};
  const MeshComparison c = compareMeshes(spiked, square(0), {.samples = 1000});
  EXPECT_EQ(c.toReference.largest, 7);
  EXPECT_EQ(c.toReference.p999, 0);
  EXPECT_EQ(c.fromReference.largest, 0);
  spiked.triangles.clear();
  EXPECT_EQ(compareMeshes(spiked, square(0), {.samples = 1000}).toReference.largest, 0) << "a vertex without a face";
}

// Three quarters of the area are one face, at a distance of 1; the rest is a hundred faces.
TEST(MeshComparison, SamplesAreEvenOverTheArea) {
  Mesh mesh;
  for (int i = 0; i < 100; ++i) addRectangle(mesh, static_cast<float>(i) * 0.01F, static_cast<float>(i + 1) * 0.01F, 0);
  addRectangle(mesh, 1, 4, 1);
  Mesh plane;
  addRectangle(plane, -10, 10, 0);
  const MeshComparison c = compareMeshes(mesh, plane, {.samples = 10'000});
  EXPECT_NEAR(c.toReference.mean, 0.75, 1e-4);
  EXPECT_NEAR(c.toReference.rms, std::sqrt(0.75), 1e-4);
}

TEST(MeshComparison, SamplesAreEvenWithinATriangle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 3}};
  mesh.triangles = {{0, 1, 2}};
  Mesh plane;
  addRectangle(plane, -10, 10, 0);
  for (int turn = 0; turn < 3; ++turn) {
    const MeshComparison c = compareMeshes(mesh, plane, {.samples = 10'000});
    EXPECT_NEAR(c.toReference.mean, 1, 0.02);
    EXPECT_NEAR(c.toReference.rms, std::sqrt(9.0 / 6), 0.02);
    std::rotate(mesh.triangles[0].begin(), mesh.triangles[0].begin() + 1, mesh.triangles[0].end());
  }
}

TEST(MeshComparison, OneInAThousandIsBeyondThePercentile) {
  Mesh plane;
  addRectangle(plane, -10, 10, 0);
  for (const auto& [part, expected] : {std::pair{0.0005F, 0.0}, {0.002F, 1.0}}) {
    Mesh mesh;
    addRectangle(mesh, 0, part, 1);
    addRectangle(mesh, part, 1, 0);
    EXPECT_EQ(compareMeshes(mesh, plane, {.samples = 100'000}).toReference.p999, expected);
  }
}

TEST(MeshComparison, AnglesAreThoseBetweenFaces) {
  Mesh tilted = square(0);
  for (Vec3f& p : tilted.positions) p.z = p.x * std::sqrt(3.0F);
  MeshComparison c = compareMeshes(tilted, square(0), {.samples = 1000});
  EXPECT_NEAR(c.meanAngle, 60, 1e-5);
  EXPECT_NEAR(c.rmsAngle, 60, 1e-5);
  EXPECT_EQ(c.opposedShare, 0);
  c = compareMeshes(insideOut(tilted), square(0), {.samples = 1000});
  EXPECT_NEAR(c.meanAngle, 120, 1e-5);
  EXPECT_EQ(c.opposedShare, 1);
}

// From a sample beyond the ridge both sides are equally far.
TEST(MeshComparison, BeyondARidgeTheSideThatTheSampleFacesCounts) {
  const MeshComparison c = compareMeshes(roof(1, 1), roof(2, 0), {.samples = 10'000});
  EXPECT_NEAR(c.toReference.largest, 1, 1e-12);
  EXPECT_EQ(c.opposedShare, 0);
  // The rest are those of the lower roof, which are nearest to the face above them.
  EXPECT_LT(c.rmsAngle, 1e-5);
}

TEST(MeshComparison, HeedsTheOriginsOfBothMeshes) {
  Mesh here = square(0), there = square(0);
  here.origin = {1e8, 0, 0};
  there.origin = {1e8, 0, 0.375};
  const MeshComparison c = compareMeshes(here, there, {.samples = 100});
  expectAll(c.toReference, 0.375);
  expectAll(c.fromReference, 0.375);
}

TEST(MeshComparison, QuadsAreTheirTriangles) {
  Mesh bent = square(0);
  bent.positions[1].z = 0.5F;
  Mesh triangles = bent;
  triangles.quads.clear();
  triangles.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_LT(compareMeshes(bent, triangles, {.samples = 1000}).toReference.largest, 1e-12);
  // One of the two rises to 0.5 at a corner, the other lies in the square.
  const double area = std::sqrt(1.5) / 2;
  EXPECT_NEAR(compareMeshes(bent, square(0), {.samples = 10'000}).toReference.mean, area / 6 / (area + 0.5), 1e-3);
  triangles.triangles = {{0, 1, 3}, {1, 2, 3}};
  EXPECT_GT(compareMeshes(bent, triangles, {.samples = 1000}).toReference.largest, 0.1);
}

TEST(MeshComparison, LeavesOutWhatIsNotFiniteAndAnglesToWhatHasNoArea) {
  Mesh mesh = square(0.25F), reference = square(0);
  for (Mesh* m : {&mesh, &reference}) {
    m->positions.push_back({kNan, 0, 0});
    m->positions.push_back({0, std::numeric_limits<float>::infinity(), 0});
    m->triangles = {{0, 1, 4}, {1, 2, 5}};
  }
  expectAll(compareMeshes(mesh, reference, {.samples = 100}).toReference, 0.25);
  // A line above the square is nearest to what is above that.
  reference.positions.push_back({0, 0, 10});
  reference.positions.push_back({1, 1, 10});
  reference.triangles = {{6, 7, 7}};
  const MeshComparison c = compareMeshes(insideOut(square(9)), reference, {.samples = 100});
  EXPECT_EQ(c.opposedShare, 0);
  EXPECT_EQ(c.meanAngle, 180) << "from the reference";
}

TEST(MeshComparison, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = sphere(40), reference = scaled(sphere(33), 1.01F);
  const auto figures = [&](int threads) {
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    MeshComparison c;
    tbb::task_arena(threads).execute([&] { c = compareMeshes(mesh, reference, {.samples = 30'000}); });
    std::array<std::uint64_t, 11> bits{};
    std::size_t i = 0;
    for (const DistanceFigures& d : {c.toReference, c.fromReference})
      for (const double x : {d.mean, d.rms, d.p999, d.largest}) bits[i++] = std::bit_cast<std::uint64_t>(x);
    for (const double x : {c.meanAngle, c.rmsAngle, c.opposedShare}) bits[i++] = std::bit_cast<std::uint64_t>(x);
    return bits;
  };
  const auto alone = figures(1);
  for (int run = 0; run < 5; ++run) EXPECT_EQ(figures(3), alone);
}

TEST(MeshComparison, RefusesWhatCannotBeCompared) {
  const auto compare = [](const Mesh& mesh, const Mesh& reference, std::size_t samples = 10) {
    static_cast<void>(compareMeshes(mesh, reference, {.samples = samples}));
  };
  const Mesh good = square(0);
  EXPECT_THROW(compare(good, good, 0), std::invalid_argument);
  Mesh line = good;
  line.quads = {{0, 1, 1, 0}};
  Mesh polygon = good;
  polygon.polygons.corners = {0, 1, 2};
  polygon.polygons.starts = {0};
  Mesh lost = good;
  lost.quads.push_back({0, 1, 2, 9});
  for (const bool isReference : {false, true}) {
    const auto with = [&](const Mesh& bad) { isReference ? compare(good, bad) : compare(bad, good); };
    EXPECT_THROW(with(Mesh{}), Error);
    EXPECT_THROW(with(line), Error);
    EXPECT_THROW(with(lost), Error);
    EXPECT_THROW(with(polygon), std::invalid_argument);
  }
}

TEST(MeshComparison, SaysHowFarItIsAndStops) {
  std::atomic<bool> stop = false;
  std::atomic<double> last = 0;
  const Monitor monitor{.progress = [&](const char*, double share) { last = std::max(last.load(), share); },
                        .stop = &stop};
  static_cast<void>(compareMeshes(sphere(10), sphere(11), {.samples = 5000}, monitor));
  EXPECT_EQ(last, 1);
  stop = true;
  EXPECT_THROW(static_cast<void>(compareMeshes(sphere(10), sphere(11), {}, monitor)), Cancelled);
}

}  // namespace
}  // namespace pdc::test
