#include "extract/vertices/patch_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "extract/topology/block_topology.h"
#include "extract/vertices/cell_rounding.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc::detail {
namespace {

constexpr double kCellHalf = 0.4999;

/// The patches of a source, block after block, each loaded into a PatchSolver.
class Patches {
 public:
  explicit Patches(const HermiteSource& source, double sigma = 0.05)
      : mSource(source),
        mBlocks(source.surfaceBlocks({})),
        mTopology(buildTopology(mBlocks, {})),
        mSampler(source),
        mVertexSolver(sigma, kFreeHalfSize),
        mSolver(mSampler, mCrossings, mVertexSolver) {}

  /// Calls visit(solver, world position of the cell's centre, metric).
  template <typename Visit>
  void forEach(Visit&& visit) {
    for (std::size_t i = 0; i < mBlocks.coords.size(); ++i) {
      const EdgeIndex edges(mBlocks.signs[i]);
      const Vec3d origin = blockOrigin(mBlocks.coords[i]);
      const CellMetric metric = blockMetric(mSource.map(), origin);
      mSampler.run({mBlocks.coords[i], mBlocks.signs[i], edges}, mTopology.blocks[i], metric);
      mCrossings.fill(mSampler.hermite(), edges, metric, mSource.map(), origin, bestSimdLevel());
      for (std::size_t k = 0; k < mSampler.patches().size(); ++k) {
        mSolver.load(k, edges);
        visit(mSolver, mSource.map().position(origin + cellCenter(mSampler.patches()[k].cell)), metric);
      }
    }
  }

 private:
  const HermiteSource& mSource;
  const SurfaceBlocks mBlocks;
  const Topology mTopology;
  BlockSampler mSampler;
  CrossingPlanes mCrossings;
  const VertexSolver mVertexSolver;
  PatchSolver mSolver;
};

constexpr double kVoxel = 0.1;

FieldSource sourceOf(FieldPtr field, double voxelSize = kVoxel) {
  return FieldSource(std::move(field), {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = voxelSize});
}

TEST(PatchSolver, LoadsTheCrossingsOfThePatch) {
  const FieldSource source = sourceOf(sphere({}, 0.73));
  std::size_t patches = 0;
  Patches(source).forEach([&](const PatchSolver& solver, const Vec3d& center, const CellMetric&) {
    ++patches;
    ASSERT_GE(solver.samples().size, 3);
    for (int i = 0; i < solver.samples().size; ++i) {
      ASSERT_NEAR(length(center + solver.samples().position[i] * kVoxel), 0.73, 1e-6);
      ASSERT_NEAR(length(solver.samples().row[i]), 1, 1e-6);
    }
  });
  EXPECT_GT(patches, 500u);
}

TEST(PatchSolver, VerticesInTheirCellsStayAndAreNotSuspect) {
  const FieldSource source = sourceOf(sphere({}, 0.73));
  Patches(source).forEach([](const PatchSolver& solver, const Vec3d&, const CellMetric& metric) {
    const Vec3d inside{0.25, -0.25, 0.125};
    const CellPlacement placed = solver.placeInCell(inside, false, kCellHalf, metric);
    ASSERT_EQ(placed.place, vecCast<float>(inside));
    ASSERT_FALSE(placed.safe);
  });
}

// A hair beyond the cell's wall is rounding; the vertex is put back.
TEST(PatchSolver, VerticesOnTheWallAreSnappedIntoTheCell) {
  const FieldSource source = sourceOf(sphere({}, 0.73));
  Patches(source).forEach([](const PatchSolver& solver, const Vec3d&, const CellMetric& metric) {
    const CellPlacement placed = solver.placeInCell({kCellHalf + 0.5 * kSnap, 0, -0.1}, false, kCellHalf, metric);
    ASSERT_EQ(placed.place.x, static_cast<float>(kCellHalf));
    ASSERT_FALSE(placed.safe);
  });
}

// All planes of a flat part meet wherever the vertex is in the plane: leaving the cell gains nothing.
TEST(PatchSolver, FlatPatchesNeverLeaveTheirCells) {
  const FieldSource source = sourceOf(plane({0.01, 0.02, 0.005}, {1, 2, 3}));
  std::size_t moved = 0;
  Patches(source).forEach([&](const PatchSolver& solver, const Vec3d& center, const CellMetric& metric) {
    if (std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) > 0.85) return;  // The box cuts it off.
    const SolvedVertex v = solver.solve(metric);
    Vec3d along = cross(Vec3d{1, 2, 3}, Vec3d{0, 0, 1});
    along *= 1.5 / length(along);
    const CellPlacement placed = solver.placeInCell(v.x + along, false, kCellHalf, metric);
    ASSERT_FALSE(placed.safe);
    for (int k = 0; k < 3; ++k) ASSERT_LE(std::abs(placed.place[k]), 0.5F);
    ASSERT_LT(planeError(solver.samples(), vecCast<double>(placed.place)), 1e-6);
    ++moved;
  });
  EXPECT_GT(moved, 200u);
}

// Beside a sharp edge the free place is on the crease and far nearer to both planes than any in the cell.
TEST(PatchSolver, VerticesOnCreasesOutsideTheirCellsAreSuspectAndKnowTheirSheets) {
  const FieldSource source = sourceOf(rotate(box({}, {0.55, 0.5, 0.45}), {1, 2, 3}, 25), kVoxel / 4);
  std::size_t suspect = 0, creased = 0;
  Patches(source, 0.01).forEach([&](const PatchSolver& solver, const Vec3d&, const CellMetric& metric) {
    const SolvedVertex v = solver.solve(metric);
    const CellPlacement placed = solver.placeInCell(v.x, false, kCellHalf, metric);
    if (!placed.safe) return;
    ++suspect;
    for (int k = 0; k < 3; ++k) ASSERT_LE(std::abs((*placed.safe)[k]), static_cast<float>(kCellHalf));
    ASSERT_EQ(placed.place, vecCast<float>(v.x));
    const auto normals = solver.creaseNormals(v.x, metric);
    if (normals[1] == Vec3f{}) return;
    ++creased;
    ASSERT_NEAR(dot(normals[0], normals[1]), 0, 1e-3);
    ASSERT_NEAR(length(normals[0]), 1, 1e-5);
  });
  EXPECT_GT(suspect, 20u);
  EXPECT_GT(creased, suspect / 2);
}

// In an ambiguous cell only the neighbourhood of the patch's own crossings is safe.
TEST(PatchSolver, AmbiguousCellsAreAlwaysSuspectWithTheMassPointSafe) {
  const FieldSource source = sourceOf(sphere({}, 0.73));
  Patches(source).forEach([](const PatchSolver& solver, const Vec3d&, const CellMetric& metric) {
    const CellPlacement placed = solver.placeInCell({0, 0, 0}, true, kCellHalf, metric);
    ASSERT_TRUE(placed.safe);
    Vec3d mean{};
    for (int i = 0; i < solver.samples().size; ++i)
      mean += solver.samples().position[i] * (1.0 / solver.samples().size);
    ASSERT_LT(length(vecCast<double>(*placed.safe) - mean), 0.02);
  });
}

}  // namespace
}  // namespace pdc::detail
