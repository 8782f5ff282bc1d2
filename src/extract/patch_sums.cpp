#include "extract/patch_sums.h"

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// By code.
constexpr auto kCellEdges = [] {
  std::array<PatchEdges, 256> edges;
  for (int code = 0; code < 256; ++code) {
    unsigned bits = 0;
    for (int e = 0; e < kEdges; ++e)
      if (changesSign(code, e)) bits |= 1u << e;
    edges[code] = PatchEdges(bits);
  }
  return edges;
}();

/// From the centre of the cell to the low end of each edge, along axis j in places 4j to 4j + 2.
alignas(64) constexpr auto kEdgeOffset = [] {
  std::array<std::array<float, kLanes>, kEdges> offset{};
  for (int e = 0; e < kEdges; ++e)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) offset[e][4 * j + i] = (edgeLowCorner(e) >> j & 1) != 0 ? 0.5F : -0.5F;
  return offset;
}();

/// The sign-changing edges of the patch that vertex v of a special cell belongs to.
unsigned edgesOf(const SpecialCell& special, unsigned present, int v) {
  int patch = kNone;
  for (int e = 0; e < kEdges; ++e)
    if (special.vertex[e] == v) patch = special.patch[e];
  unsigned edges = 0;
  for (unsigned bits = present; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    if (special.patch[e] == patch) edges |= 1u << e;
  }
  return edges;
}

}  // namespace

void PatchSums::list(const BlockTopology& topology, const BlockSigns& signs) {
  mPatches.resize(topology.vertexCount);
  mForSource.resize(topology.vertexCount);
  std::size_t next = 0;
  const auto add = [&](int cell, bool strict, const PatchEdges& edges, unsigned bits) {
    mForSource[next] = {static_cast<std::uint16_t>(cell), static_cast<std::uint16_t>(bits)};
    mPatches[next++] = {static_cast<std::uint16_t>(cell), strict, edges};
  };
  auto special = topology.special.begin();
  for (int x = 0; x < kBlockSize; ++x)
    for (std::uint64_t w = topology.cells.word[x]; w != 0; w &= w - 1) {
      const int bit = std::countr_zero(w), cell = 64 * x + bit;
      const int code = cellCode(signs, x, bit >> 3, bit & 7);
      const CellEntry& entry = kCellTable[code];
      if (special == topology.special.end() || special->cell != cell) {
        add(cell, entry.strict, kCellEdges[code], entry.edges);
        continue;
      }
      for (int v = 0; v < special->vertexCount; ++v) {
        const unsigned edgesOfVertex = edgesOf(*special, entry.edges, v);
        add(cell, true, PatchEdges(edgesOfVertex), edgesOfVertex);
      }
      ++special;
    }
}

void PatchSums::sum(const CrossingRows& crossings, const EdgeIndex& edges, SimdLevel level) {
  mSums.resize(mPatches.size());
  mRhs.resize(mPatches.size());
  forEachBlock(level, mPatches.size(), [&](std::size_t i) {
    const PatchEdges& patch = mPatches[i].edges;
    const std::uint16_t* number = edges.numbers() + mPatches[i].slot();
    Float16 sum{}, shifted{};
    const auto add = [&](int k, unsigned keep) {
      const int e = patch.edge[k];
      const Float16& row = crossings.rows()[(number[kEdgeSlot[e]] + 1u) & keep];
      Float16 offset;
      std::memcpy(&offset, &kEdgeOffset[e], sizeof offset);
      sum += row;
      shifted += row * offset;
    };
    // Nearly all patches have three to six edges: adding nothing is cheaper than a branch that cannot be foreseen.
    constexpr int kUsual = 6;
    for (int k = 0; k < kUsual; ++k) add(k, k < patch.count ? ~0u : 0u);
    for (int k = kUsual; k < patch.count; ++k) add(k, ~0u);
    std::memcpy(&mSums[i], &sum, sizeof sum);
    Float4 part[4], shift[4];
    std::memcpy(part, &sum, sizeof part);
    std::memcpy(shift, &shifted, sizeof shift);
    store(part[3] + (shift[0] + shift[1] + shift[2]), mRhs[i].data());
  });
}

}  // namespace pdc::detail
