#include "extract/topology/patch_list.h"

#include <array>
#include <bit>
#include <cstring>

namespace pdc::detail {
namespace {

/// A cell's corners as they come in rows along z: those of row (x, y) in bits 2y + 4x and one more.
constexpr int codeOfPairs(int pairs) {
  int code = 0;
  for (int c = 0; c < kCorners; ++c) {
    const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
    code |= (pairs >> (4 * x + 2 * y + z) & 1) << c;
  }
  return code;
}

/// The sign-changing edges of a cell by its pairs of corners, and in bit kEdges whether it is ambiguous.
constexpr auto kPairEdges = [] {
  std::array<std::uint16_t, 256> edges{};
  for (int pairs = 0; pairs < 256; ++pairs) {
    const CellEntry entry = makeCellEntry(codeOfPairs(pairs));
    edges[pairs] = static_cast<std::uint16_t>(entry.edges | unsigned{entry.ambiguous} << kEdges);
  }
  return edges;
}();
constexpr unsigned kEdgeBits = (1u << kEdges) - 1;

/// The sign-changing edges of the patch that vertex v of a multi-vertex cell belongs to.
unsigned edgesOf(const MultiVertexCell& multiVertex, unsigned present, int v) {
  int patch = kNone;
  for (int e = 0; e < kEdges; ++e)
    if (multiVertex.vertex[e] == v) patch = multiVertex.patch[e];
  unsigned edges = 0;
  for (unsigned bits = present; bits != 0; bits &= bits - 1) {
    const int e = std::countr_zero(bits);
    if (multiVertex.patch[e] == patch) edges |= 1u << e;
  }
  return edges;
}

}  // namespace

void PatchList::fill(const BlockTopology& topology, const BlockSigns& signs) {
  mPatches.resize(topology.vertexCount);
  mAmbiguous.resize(topology.vertexCount);
  mMultiVertex.clear();
  std::size_t next = 0;
  unsigned any = 0;
  const auto add = [&, patches = mPatches.data(), ambiguous = mAmbiguous.data()](BlockCell cell, unsigned edges) {
    any |= edges;
    patches[next] = {cell, static_cast<std::uint16_t>(edges & kEdgeBits)};
    ambiguous[next++] = static_cast<std::uint8_t>(edges >> kEdges);
  };
  // The pairs of corners at (y, z) and (y + 1, z) of a layer.
  const auto twoPairs = [](const std::uint16_t* row, int z) {
    std::uint32_t two;
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(&two, row, sizeof two);
    return two >> z & 0x30003;
  };
  auto multiVertex = topology.multiVertex.begin();
  for (int x = 0; x < kBlockSize; ++x)
    for (std::uint64_t w = topology.cells.word[x]; w != 0; w &= w - 1) {
      const int bit = std::countr_zero(w), z = bit & 7;
      const BlockCell cell{static_cast<std::uint16_t>(64 * x + bit)};
      const std::uint16_t* row = &signs.row[static_cast<std::size_t>(kBlockPoints * x + (bit >> 3))];
      const std::uint32_t pairs = twoPairs(row, z) | twoPairs(row + kBlockPoints, z) << 4;
      const unsigned edges = kPairEdges[(pairs | pairs >> 14) & 0xFF];
      if (multiVertex == topology.multiVertex.end() || multiVertex->cell != cell) {
        add(cell, edges);
        continue;
      }
      for (int v = 0; v < multiVertex->vertexCount; ++v) {
        mMultiVertex.push_back(static_cast<std::uint32_t>(next));
        add(cell, edgesOf(*multiVertex, edges & kEdgeBits, v) | 1u << kEdges);
      }
      ++multiVertex;
    }
  mAnyAmbiguous = any > kEdgeBits;
}

}  // namespace pdc::detail
