#include "sample/creases/distance_planes.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "sample/cell_edges.h"
#include "sample/creases/crease_sheets.h"
#include "sample/creases/gradient_jumps.h"
#include "sample/creases/voxel_planes.h"

namespace pdc::detail {
namespace {

constexpr PlaneTolerance kTolerance{.cutoff = 0.04F, .scale = 0.001F, .jump = 0.01F};

Vec3d unit(Vec3d v) { return v * (1 / length(v)); }

const Vec3d kLeft = unit({-0.8, 0.3, 0.5}), kRight = unit({0.7, 0.4, 0.6});
const Vec3d kTip{4.3, 4.2, 4.4};

/// The distance to the solid between two planes that meet at kTip, as its inside and the parts before its faces see it;
/// beyond them the edge is nearest.
double wedge(const Vec3d& p) {
  const double a = dot(p - kTip, kLeft), b = dot(p - kTip, kRight);
  const Vec3d onLeft = p - kLeft * a, onRight = p - kRight * b;
  if (dot(onLeft - kTip, kRight) <= 0 || dot(onRight - kTip, kLeft) <= 0 || std::max(a, b) <= 0) return std::max(a, b);
  const Vec3d along = unit(cross(kLeft, kRight)), d = p - kTip;
  return length(d - along * dot(d, along));
}

double ball(const Vec3d& p) { return length(p - Vec3d{-9, 3, 2}) - 13; }

DistanceStencil stencil(const std::function<double(const Vec3d&)>& distance) {
  DistanceStencil w;
  for (int x = -3; x <= 11; ++x)
    for (int y = -3; y <= 11; ++y)
      for (int z = -3; z <= 11; ++z)
        w.value[DistanceStencil::index(x, y, z)] = static_cast<float>(distance({double(x), double(y), double(z)}));
  return w;
}

/// A block with the crossings and patches of a wedge, a patch per cell that changes sign.
struct WedgeBlock {
  WedgeBlock() {
    for (int x = 0; x < kBlockPoints; ++x)
      for (int y = 0; y < kBlockPoints; ++y)
        for (int z = 0; z < kBlockPoints; ++z)
          if (distances.value[DistanceStencil::index(x, y, z)] < 0)
            signs.row[kBlockPoints * x + y] |= static_cast<std::uint16_t>(1U << z);
    edges = std::make_unique<EdgeIndex>(signs);
    edges->forEach([&](int i, int axis, int x, int y, int z) {
      const float* p = &distances.value[DistanceStencil::index(x, y, z)];
      hermite.t[i] = p[0] / (p[0] - p[DistanceStencil::kStep[axis]]);
      Vec3d n;
      for (int k = 0; k < 3; ++k) n[k] = double{p[DistanceStencil::kStep[k]]} - p[-DistanceStencil::kStep[k]];
      n = unit(n);
      hermite.nx[i] = static_cast<float>(n.x);
      hermite.ny[i] = static_cast<float>(n.y);
      hermite.nz[i] = static_cast<float>(n.z);
    });
    for (int x = 0; x < kBlockSize; ++x)
      for (int y = 0; y < kBlockSize; ++y)
        for (int z = 0; z < kBlockSize; ++z) addPatch(x, y, z);
  }

  void addPatch(int x, int y, int z) {
    const int code = cellCode(signs, x, y, z);
    std::uint16_t crossed = 0;
    for (int e = 0; e < 12; ++e)
      if ((code >> kCellEdge[e].low & 1) != (code >> kCellEdge[e].high & 1))
        crossed |= static_cast<std::uint16_t>(1U << e);
    if (crossed != 0) patches.push_back({static_cast<std::uint16_t>(64 * x + 8 * y + z), crossed});
  }

  [[nodiscard]] FeaturePlanes find() const {
    FeaturePlanes planes;
    findFeaturePlanes(
        {signs, *edges, hermite, patches}, {}, [this](DistanceStencil& to) { to.value = distances.value; }, planes);
    return planes;
  }

  const DistanceStencil distances = stencil(wedge);
  BlockSigns signs;
  std::unique_ptr<EdgeIndex> edges;
  HermiteBlock hermite{};
  std::vector<SurfacePatch> patches;
};

/// Runs on a thread of its own with a stack of 128 kB, which is what some C libraries give to threads.
void runOnSmallStack(std::function<void()> run) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 128 << 10), 0);
  pthread_t thread{};
  const auto start = [](void* f) -> void* {
    (*static_cast<std::function<void()>*>(f))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, start, &run), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

double degrees(const Vec3f& a, const Vec3d& b) {
  return std::acos(std::min(1.0, dot(vecCast<double>(a), b))) * 180 / 3.14159265358979323846;
}

SurfaceSamples samplesAbout(const DistanceStencil& w, const Coord& cell, const Mat3f& M = Mat3f::identity(),
                            SimdLevel level = bestSimdLevel()) {
  const auto voxels = std::make_unique<VoxelPlanes>(w, kTolerance, M, level);
  SurfaceSamples samples;
  voxels->request(cell);
  voxels->gather(cell, samples);
  return samples;
}

/// Where a sample of the cell {4, 4, 4} lies, from kTip; the lattice's steps are one voxel.
Vec3d fromTip(const SurfaceSamples& samples, int i) {
  return vecCast<double>(samples.foot(i)) + Vec3d{4.5, 4.5, 4.5} - kTip;
}

TEST(VoxelPlanes, APlaneIsFoundExactly) {
  const SurfaceSamples samples = samplesAbout(stencil([](const Vec3d& p) { return dot(p - kTip, kLeft); }), {4, 4, 4});
  ASSERT_EQ(samples.count, 64);
  for (int i = 0; i < samples.count; ++i) {
    EXPECT_LT(degrees(samples.normal(i), kLeft), 0.05);
    EXPECT_NEAR(dot(fromTip(samples, i), kLeft), 0, 1e-5);
  }
}

TEST(VoxelPlanes, BesideAnEdgePlanesOfLittleErrorAreThoseOfItsSides) {
  const SurfaceSamples samples = samplesAbout(stencil(wedge), {4, 4, 4});
  int left = 0, right = 0;
  for (int i = 0; i < samples.count; ++i) {
    if (!(samples.column[SurfaceSamples::kFitWeight][i] > 0.5F * samples.column[SurfaceSamples::kSupport][i])) continue;
    const bool isLeft = degrees(samples.normal(i), kLeft) < 1, isRight = degrees(samples.normal(i), kRight) < 1;
    left += isLeft;
    right += isRight;
    // What is nearest to the edge says something true as well: a plane through the edge.
    const Vec3d along = unit(cross(kLeft, kRight)), foot = fromTip(samples, i);
    const bool edge = length(foot - along * dot(foot, along)) < 0.05;
    EXPECT_TRUE(isLeft || isRight || edge) << foot.x << ' ' << foot.y << ' ' << foot.z;
  }
  EXPECT_GT(left, 5);
  EXPECT_GT(right, 5);
}

TEST(VoxelPlanes, StretchedLatticesGiveTheSamePlanes) {
  // One lattice step along x is half a voxel, along y two.
  const auto w = stencil([](const Vec3d& p) { return dot(Vec3d{0.5 * p.x, 2 * p.y, p.z} - kTip, kLeft); });
  const SurfaceSamples samples = samplesAbout(w, {5, 2, 3}, Mat3f::diagonal(0.5F, 2, 1));
  ASSERT_EQ(samples.count, 64);
  const Vec3d center{0.5 * 5.5, 2 * 2.5, 3.5};
  for (int i = 0; i < samples.count; ++i) {
    EXPECT_LT(degrees(samples.normal(i), kLeft), 0.05);
    EXPECT_NEAR(dot(vecCast<double>(samples.foot(i)) + center - kTip, kLeft), 0, 1e-5);
  }
}

TEST(VoxelPlanes, WhatIsNoDistanceGivesNone) {
  const SurfaceSamples samples =
      samplesAbout(stencil([](const Vec3d& p) { return 1.3 * dot(p - kTip, kLeft); }), {4, 4, 4});
  for (int i = 0; i < samples.count; ++i) EXPECT_EQ(samples.column[SurfaceSamples::kSupport][i], 0);
}

TEST(VoxelPlanes, DoNotDependOnOtherCells) {
  const DistanceStencil w = stencil(wedge);
  const Coord cell{4, 4, 4};
  const SurfaceSamples alone = samplesAbout(w, cell);
  const auto voxels = std::make_unique<VoxelPlanes>(w, kTolerance, Mat3f::identity());
  // In the rows of the cell, so that these are too long for half the lanes, and in rows of their own.
  for (const Coord& other : {Coord{4, 4, 0}, Coord{4, 5, 7}, Coord{0, 0, 0}, Coord{7, 7, 7}}) voxels->request(other);
  voxels->request(cell);
  SurfaceSamples among;
  voxels->gather(cell, among);
  ASSERT_EQ(among.count, alone.count);
  ASSERT_GT(alone.count, 0);
  for (int c = 0; c < SurfaceSamples::kColumns; ++c)
    for (int i = 0; i < alone.count; ++i) EXPECT_EQ(among.column[c][i], alone.column[c][i]) << c << ' ' << i;
}

TEST(VoxelPlanes, DoNotDependOnTheProcessor) {
  const DistanceStencil w = stencil(wedge);
  const SurfaceSamples best = samplesAbout(w, {4, 4, 4}),
                       baseline = samplesAbout(w, {4, 4, 4}, Mat3f::identity(), SimdLevel::kBaseline);
  ASSERT_EQ(best.count, baseline.count);
  for (int c = 0; c < SurfaceSamples::kColumns; ++c)
    for (int i = 0; i < best.count; ++i) EXPECT_EQ(best.column[c][i], baseline.column[c][i]);
}

TEST(CreaseSheets, AnEdgeHasTwoThatMeetOnIt) {
  SurfaceSamples samples = samplesAbout(stencil(wedge), {4, 4, 4}), again = samples;
  SheetWeights weights;
  const CreaseSheets sheets = findSheets(samples, 0, weights);
  ASSERT_GE(sheets.count, 2);
  EXPECT_LT(std::min(degrees(vecCast<float>(sheets.sheet[0].normal), kLeft),
                     degrees(vecCast<float>(sheets.sheet[0].normal), kRight)),
            1);
  const Vec3d meeting = meetingPoint(sheets.all().first(2), {}, 0.01) + Vec3d{4.5, 4.5, 4.5} - kTip,
              along = unit(cross(kLeft, kRight));
  EXPECT_LT(length(meeting - along * dot(meeting, along)), 0.01);

  const CreaseSheets baseline = findSheets(again, 0, weights, SimdLevel::kBaseline);
  ASSERT_EQ(sheets.count, baseline.count);
  for (int i = 0; i < sheets.count; ++i) {
    EXPECT_EQ(sheets.sheet[i].center, baseline.sheet[i].center);
    EXPECT_EQ(sheets.sheet[i].normal, baseline.sheet[i].normal);
    EXPECT_EQ(sheets.sheet[i].support, baseline.sheet[i].support);
  }
}

TEST(CreaseSheets, ThoseWithLittleSupportAreDropped) {
  CreaseSheets sheets;
  for (const double support : {0.3, 2.0, 0.1}) sheets.sheet[sheets.count++].support = support;
  sheets.dropUnsupported(0.05);
  EXPECT_EQ(sheets.count, 3);
  sheets.dropUnsupported(0.1);
  ASSERT_EQ(sheets.count, 2);
  EXPECT_EQ(sheets.sheet[0].support, 0.3);
  EXPECT_EQ(sheets.sheet[1].support, 2.0);
}

TEST(GradientJumps, SmoothSurfacesHaveNone) {
  const DistanceStencil w = stencil(ball);
  GradientJumps jumps(w, kTolerance.jump);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) EXPECT_TRUE(jumps.noneAt({x, y, z}));
}

TEST(GradientJumps, CellsAtAnEdgeHaveSome) {
  const DistanceStencil w = stencil(wedge);
  EXPECT_FALSE(GradientJumps(w, kTolerance.jump).noneAt({4, 4, 4}));
}

TEST(GradientJumps, DoNotDependOnTheProcessor) {
  const DistanceStencil w = stencil(wedge);
  GradientJumps best(w, kTolerance.jump), baseline(w, kTolerance.jump, SimdLevel::kBaseline);
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) EXPECT_EQ(best.noneAt({x, y, z}), baseline.noneAt({x, y, z}));
}

TEST(DistancePlanes, AnEdgesPatchesHaveThePlanesOfItsSides) {
  const auto block = std::make_unique<WedgeBlock>();
  const FeaturePlanes planes = block->find();
  int both = 0;
  for (const FeaturePlanes::Patch& patch : planes.patches) both += patch.count == 2;
  EXPECT_GT(both, 3);
}

TEST(DistancePlanes, NeedNoLargeStack) {
  const auto block = std::make_unique<WedgeBlock>();
  std::size_t found = 0;
  runOnSmallStack([&] { found = block->find().patches.size(); });
  EXPECT_EQ(found, block->find().patches.size());
  EXPECT_GT(found, 3u);
}

}  // namespace
}  // namespace pdc::detail
