#include "extract/mesh_slab.h"

#include <gtest/gtest.h>

#include <random>

#include "extract/certify/uncertified_mesh.h"
#include "extract/turned_layer.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/sampled_source.h"

namespace pdc::detail {
namespace {

/// Joins slabs array by array, as the whole mesh has them.
Mesh joined(const std::vector<MeshSlab>& slabs) {
  Mesh mesh;
  std::uint64_t allSolved = 0;
  for (const MeshSlab& s : slabs) allSolved += s.own.solved;
  const auto append = [](auto& to, const auto& from, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to.push_back(from[i]);
  };
  for (const MeshSlab& s : slabs) append(mesh.positions, s.mesh.positions, 0, s.own.solved);
  for (const MeshSlab& s : slabs) append(mesh.positions, s.mesh.positions, s.own.solved, s.mesh.positions.size());
  std::uint64_t solved = 0, added = 0;
  for (const MeshSlab& s : slabs) {
    const std::uint64_t solvedListed = s.layerBefore.solved + s.own.solved;
    const auto number = [&](auto face) {
      for (std::uint32_t& corner : face)
        corner = static_cast<std::uint32_t>(corner < solvedListed
                                                ? corner + solved - s.layerBefore.solved
                                                : corner - solvedListed + allSolved + added - s.layerBefore.added);
      return face;
    };
    for (const Quad& q : s.mesh.quads) mesh.quads.push_back(number(q));
    for (const Triangle& t : s.mesh.triangles) mesh.triangles.push_back(number(t));
    solved += s.own.solved;
    added += s.own.added;
  }
  return mesh;
}

MeshSlab slabOf(const HermiteSource& source, const SurfaceBlocks& blocks, LayerRange layers, int halo = kLeastHalo) {
  return contourSlab(source, blocks, {.layers = layers, .halo = halo, .place = {}}, {}, {});
}

/// Cuts a surface into slabs at some layers.
std::vector<MeshSlab> slabsOf(const HermiteSource& source, const std::vector<int>& cuts, int halo = kLeastHalo) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  std::vector<MeshSlab> slabs;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    slabs.push_back(slabOf(source, blocks, {cuts[i], cuts[i + 1]}, halo));
  return slabs;
}

/// Random cuts, with the ends of all layers.
std::vector<int> randomCuts(const SurfaceBlocks& blocks, std::mt19937& random) {
  const int first = blocks.coords.front()[0], last = blocks.coords.back()[0];
  std::vector<int> cuts{first};
  for (int x = first + 1; x <= last; ++x)
    if (random() % 3 == 0) cuts.push_back(x);
  cuts.push_back(last + 1);
  return cuts;
}

/// Whether all that neighbours both contoured has the same history.
bool agree(const std::vector<MeshSlab>& slabs) {
  for (std::size_t s = 1; s < slabs.size(); ++s)
    if (slabs[s - 1].high != slabs[s].low) return false;
  return true;
}

void expectTheWhole(const HermiteSource& slow, int cuttings) {
  const SampledSource source(slow);
  ContourReport report;
  const Mesh whole = contour(source, {}, &report);
  ASSERT_GT(report.outOfCell, 20U) << "there must be something to decide";
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  std::mt19937 random(7);
  for (int i = 0; i < cuttings; ++i) {
    const std::vector<int> cuts = randomCuts(blocks, random);
    std::vector<MeshSlab> slabs = slabsOf(source, cuts);
    if (!agree(slabs)) slabs = slabsOf(source, cuts, 2 * kLeastHalo);
    EXPECT_TRUE(agree(slabs));
    for (std::size_t s = 1; s < slabs.size(); ++s) EXPECT_EQ(slabs[s - 1].lastLayer, slabs[s].layerBefore);
    const Mesh mesh = joined(slabs);
    EXPECT_TRUE(mesh.positions == whole.positions);
    EXPECT_TRUE(mesh.quads == whole.quads);
    EXPECT_TRUE(mesh.triangles == whole.triangles);
  }
}

FieldSource rough(double voxelSize, double frequency) {
  return {subtract({sphere({}, 0.9), simplexNoise({.frequency = frequency})}),
          {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = voxelSize}};
}

TEST(MeshSlab, SlabsOfACreasedSolidAreTheWhole) { expectTheWhole(creasedSolid(100), 3); }

TEST(MeshSlab, SlabsOfRoughSurfacesAreTheWhole) { expectTheWhole(rough(2.0 / 88, 6), 1); }

TEST(MeshSlab, SlabsOfNoiseBelowTheVoxelWithItsFansAreTheWhole) {
  const FieldSource source = rough(2.0 / 56, 26);
  ContourReport report;
  ASSERT_FALSE(contour(source, {}, &report).empty());
  EXPECT_GT(report.fans, 20U);
  expectTheWhole(source, 1);
}

TEST(MeshSlab, WhatDiffersBesideACutShowsInTheHistories) {
  const FieldSource slow = rough(2.0 / 64, 1.5);  // Eight layers.
  const SampledSource source(slow);
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  const MeshSlab low = slabOf(source, blocks, {0, 4});
  EXPECT_TRUE(low.high == slabOf(source, blocks, {4, 8}).low);
  for (int layer = 0; layer < 8; ++layer) {
    const MeshSlab high = slabOf(TurnedLayer(source, layer), blocks, {4, 8});
    EXPECT_FALSE(low.high == high.low) << "layer " << layer;
  }
}

TEST(MeshSlab, OptionsOfWholeMeshesAreRefused) {
  const FieldSource source = rough(2.0 / 64, 6);
  EXPECT_THROW(std::ignore = contourSlab(source, source.surfaceBlocks({}), {}, {.adaptive = 0.1}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace pdc::detail
