#include "extract/topology/block_topology.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "parallel/block_progress.h"

namespace pdc::detail {
namespace {

/// The low byte of each of eight consecutive rows.
std::uint64_t lowBytes(const std::uint16_t* row, int shift) {
  const auto four = [&](int first) {
    std::uint64_t w;
    static_assert(sizeof w == 4 * sizeof *row);
    std::memcpy(&w, row + first, sizeof w);
    w = w >> shift & 0x00FF00FF00FF00FF;
    w = (w | w >> 8) & 0x0000FFFF0000FFFF;
    return (w | w >> 16) & 0xFFFFFFFF;
  };
  return four(0) | four(4) << 32;
}

/// One layer of a block's points as seen by the 64 cells above it: the points at (y, z), (y + 1, z), (y, z + 1) and
/// (y + 1, z + 1) of cell (y, z) in bit 8y + z.
struct PointLayer {
  PointLayer() = default;
  PointLayer(const BlockSigns& signs, int x) {
    const std::uint16_t* row = &signs.row[static_cast<std::size_t>(kBlockPoints * x)];
    here = lowBytes(row, 0), y = lowBytes(row + 1, 0), z = lowBytes(row, 1), yz = lowBytes(row + 1, 1);
  }
  [[nodiscard]] std::uint64_t any() const { return here | y | z | yz; }
  [[nodiscard]] std::uint64_t all() const { return here & y & z & yz; }

  std::uint64_t here = 0, y = 0, z = 0, yz = 0;
};

/// Faces with two inside corners that face each other, from the corners' signs in order about the edge.
std::uint64_t ambiguousFaces(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
  return ~(a ^ c) & ~(b ^ d) & (a ^ b);
}

/// Corners that differ from all their neighbours and are like the one across the cell.
std::uint64_t loneCorners(std::uint64_t c, std::uint64_t across, std::uint64_t n0, std::uint64_t n1, std::uint64_t n2) {
  return ~(c ^ across) & (c ^ n0) & (c ^ n1) & (c ^ n2);
}

/// Among the 64 cells between two layers all that are ambiguous (see CellEntry), and few others.
std::uint64_t mayBeAmbiguous(const PointLayer& l, const PointLayer& h) {
  return ambiguousFaces(l.here, l.y, l.yz, l.z) | ambiguousFaces(h.here, h.y, h.yz, h.z) |
         ambiguousFaces(l.here, l.z, h.z, h.here) | ambiguousFaces(l.y, l.yz, h.yz, h.y) |
         ambiguousFaces(l.here, l.y, h.y, h.here) | ambiguousFaces(l.z, l.yz, h.yz, h.z) |
         loneCorners(l.here, h.yz, l.y, l.z, h.here) | loneCorners(l.y, h.z, l.here, l.yz, h.y) |
         loneCorners(l.z, h.y, l.here, l.yz, h.z) | loneCorners(l.yz, h.here, l.y, l.z, h.yz);
}

/// Finds the seven blocks below each of a run of ascending blocks in the sorted list.
class LowerBlocks {
 public:
  LowerBlocks(const std::vector<Coord>& blocks, std::size_t first) : mBlocks(blocks) {
    for (int i = 1; i < 8; ++i)
      mNext[i] = static_cast<std::size_t>(std::lower_bound(blocks.begin(), blocks.end(), below(blocks[first], i)) -
                                          blocks.begin());
  }
  /// Entry 4dx + 2dy + dz is the block at -(dx, dy, dz). Blocks must come in ascending order.
  void find(std::size_t block, std::array<std::int32_t, 8>& lower) {
    lower[0] = static_cast<std::int32_t>(block);
    for (int i = 1; i < 8; ++i) {
      const Coord wanted = below(mBlocks[block], i);
      while (mBlocks[mNext[i]] < wanted) ++mNext[i];  // Stops at the block itself at the latest.
      lower[i] = mBlocks[mNext[i]] == wanted ? static_cast<std::int32_t>(mNext[i]) : BlockIndex::kMissing;
    }
  }

 private:
  static Coord below(const Coord& b, int i) { return {b[0] - (i >> 2), b[1] - (i >> 1 & 1), b[2] - (i & 1)}; }

  const std::vector<Coord>& mBlocks;
  std::array<std::size_t, 8> mNext{};
};

/// Counts one block. Cells up to one beyond the block on each side are reached through the neighbouring blocks.
class BlockCounter {
 public:
  /// \param multiVertex the cells of blocks before, to which those of this one are added.
  BlockCounter(const SurfaceBlocks& blocks, const BlockIndex& index, FlipRule rule, std::size_t i, BlockTopology& out,
               std::vector<MultiVertexCell>& multiVertex)
      : mBlocks(blocks),
        mIndex(index),
        mRule(rule),
        mCoord(blocks.coords[i]),
        mSigns(blocks.signs[i]),
        mOut(out),
        mMultiVertex(multiVertex),
        mFirstMultiVertex(multiVertex.size()) {}

  /// Sets all but the block's lower neighbours, its list of multi-vertex cells and the numbers of its first vertex and
  /// quad.
  void run() {
    mOut.openArcs = 0;
    findCellsAndEdges();
    if (mBlocks.open) dropIncompleteEdges();
    findMultiVertexCells();
    std::uint64_t before = 0;
    for (int x = 0; x < kBlockSize; ++x) {
      mOut.cellsBefore[x] = static_cast<std::uint16_t>(before);
      before += bitCount(mOut.cells.word[x]);
    }
    mOut.vertexCount = static_cast<std::uint32_t>(before + extraVertices());
    mOut.quadCount = 0;
    for (int i = 0; i < 3 * kBlockSize; ++i) {
      mOut.quadsBefore[i] = static_cast<std::uint16_t>(mOut.quadCount);
      mOut.quadCount += static_cast<std::uint32_t>(bitCount(mOut.edges[i / kBlockSize].word[i % kBlockSize]));
    }
  }

 private:
  void findCellsAndEdges() {
    PointLayer below, above(mSigns, 0);
    for (int x = 0; x < kBlockSize; ++x) {
      below = above;
      above = PointLayer(mSigns, x + 1);
      mOut.cells.word[x] = (below.any() | above.any()) & ~(below.all() & above.all()) & mSigns.cells.word[x];
      mOut.edges[0].word[x] = below.here ^ above.here;
      mOut.edges[1].word[x] = below.here ^ below.y;
      mOut.edges[2].word[x] = below.here ^ below.z;
      mMayBeAmbiguous[x] = mayBeAmbiguous(below, above);
    }
  }

  /// The block that holds a cell given relative to this one, from -8 to 15 on each axis; null if it has no surface.
  const BlockSigns* blockAt(int x, int y, int z) const {
    const Coord c{mCoord[0] + (x >> 3), mCoord[1] + (y >> 3), mCoord[2] + (z >> 3)};
    if (c == mCoord) return &mSigns;
    const std::int32_t i = mIndex.find(c);
    return i == BlockIndex::kMissing ? nullptr : &mBlocks.signs[i];
  }

  bool takesPart(int x, int y, int z) const {
    const BlockSigns* s = blockAt(x, y, z);
    return s != nullptr && s->cells.test(x & 7, y & 7, z & 7);
  }

  /// True if all four cells about the edge from lattice point p take part.
  bool hasQuad(Axis axis, const Coord& p) const {
    const Axis u = nextAxis(axis), v = previousAxis(axis);
    for (int k = 0; k < 4; ++k) {
      Coord c = p;
      c[u] -= k & 1;
      c[v] -= k >> 1;
      if (!takesPart(c[0], c[1], c[2])) return false;
    }
    return true;
  }

  void dropIncompleteEdges() {
    for (const Axis a : kAxes)
      for (int x = 0; x < kBlockSize; ++x)
        for (std::uint64_t w = mOut.edges[a].word[x]; w != 0; w &= w - 1) {
          const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
          if (!hasQuad(a, {x, y, z})) mOut.edges[a].reset(x, y, z);
        }
  }

  /// Sign-changing edges of a cell that have a quad.
  unsigned presentEdges(int x, int y, int z, unsigned edges) const {
    unsigned present = 0;
    for (unsigned e = edges; e != 0; e &= e - 1) {
      const int edge = std::countr_zero(e);
      const Coord step = cornerStep(kCellEdge[edge].low);
      if (hasQuad(kCellEdge[edge].axis, {x + step[0], y + step[1], z + step[2]})) present |= 1u << edge;
    }
    return present;
  }

  /// The symmetric rule: a cell is flipped if the cell beyond its ambiguous face is of the same kind.
  bool flips(int x, int y, int z, const CellEntry& entry) const {
    if (entry.flipFace == kNone || mRule == FlipRule::kNever) return false;
    Coord c{x, y, z};
    c[entry.flipFace / 2] += (entry.flipFace & 1) ? 1 : -1;
    const BlockSigns* s = blockAt(c[0], c[1], c[2]);
    return s != nullptr && kCellTable[cellCode(*s, c[0] & 7, c[1] & 7, c[2] & 7)].flipFace != kNone;
  }

  void findMultiVertexCells() {
    for (int x = 0; x < kBlockSize; ++x)
      for (std::uint64_t w = mOut.cells.word[x] & (mBlocks.open ? ~std::uint64_t{0} : mMayBeAmbiguous[x]); w != 0;
           w &= w - 1) {
        const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
        const int code = cellCode(mSigns, x, y, z);
        const CellEntry& entry = kCellTable[code];
        const bool flip = flips(x, y, z, entry);
        const Patches& patches = flip ? entry.flipped : entry.patches;
        if (mBlocks.open) {
          addOpenCell(x, y, z, code, flip, patches);
        } else if (patches.count > 1) {
          addMultiVertex(BlockCell::at(x, y, z), patches, patches);
        }
      }
  }

  void addOpenCell(int x, int y, int z, int code, bool flip, const Patches& patches) {
    const unsigned edges = kCellTable[code].edges;
    const unsigned present = presentEdges(x, y, z, edges);
    if (present == edges) {
      if (patches.count > 1) addMultiVertex(BlockCell::at(x, y, z), patches, patches);
      return;
    }
    if (present == 0) return mOut.cells.reset(x, y, z);
    // Each run of quads gets a copy of the vertex: sharing one would pinch the surface at a point.
    const Patches arcs = connect(segments(code, flip), present);
    unsigned open = 0;
    for (unsigned e = edges; e != 0; e &= e - 1) {
      const int edge = std::countr_zero(e);
      if ((present >> edge & 1) != 0) continue;
      for (int other = 0; other < kEdges; ++other)
        if ((present >> other & 1) != 0 && patches.vertex[other] == patches.vertex[edge])
          open |= 1u << arcs.vertex[other];
    }
    mOut.openArcs += static_cast<std::uint32_t>(std::popcount(open));
    addMultiVertex(BlockCell::at(x, y, z), arcs, patches);
  }

  void addMultiVertex(BlockCell cell, const Patches& vertices, const Patches& patches) {
    mMultiVertex.push_back(
        {cell, vertices.count, static_cast<std::uint16_t>(extraVertices()), vertices.vertex, patches.vertex});
  }

  /// Vertices beyond one per cell in the block's multi-vertex cells so far.
  [[nodiscard]] unsigned extraVertices() const {
    if (mMultiVertex.size() == mFirstMultiVertex) return 0;
    return mMultiVertex.back().extraBefore + mMultiVertex.back().vertexCount - 1u;
  }

  const SurfaceBlocks& mBlocks;
  const BlockIndex& mIndex;
  const FlipRule mRule;
  const Coord mCoord;
  const BlockSigns& mSigns;
  BlockTopology& mOut;
  std::vector<MultiVertexCell>& mMultiVertex;
  const std::size_t mFirstMultiVertex;
  std::array<std::uint64_t, kBlockSize> mMayBeAmbiguous;
};

/// The first multi-vertex cell that is not before `cell`.
std::span<const MultiVertexCell>::iterator firstMultiVertexFrom(std::span<const MultiVertexCell> multiVertex,
                                                                BlockCell cell) {
  return std::lower_bound(multiVertex.begin(), multiVertex.end(), cell,
                          [](const MultiVertexCell& s, BlockCell c) { return s.cell < c; });
}

}  // namespace

const MultiVertexCell* BlockTopology::findMultiVertex(BlockCell cell) const {
  const auto it = firstMultiVertexFrom(multiVertex, cell);
  return it != multiVertex.end() && it->cell == cell ? &*it : nullptr;
}

std::uint64_t BlockTopology::multiVertexOffset(BlockCell cell, int edge) const {
  const auto it = firstMultiVertexFrom(multiVertex, cell);
  std::uint64_t n = 0;
  if (it != multiVertex.begin()) n = std::prev(it)->extraBefore + std::prev(it)->vertexCount - 1u;
  if (it != multiVertex.end() && it->cell == cell) n += static_cast<std::uint64_t>(it->vertex[edge]);
  return n;
}

Topology buildTopology(const SurfaceBlocks& blocks, const Monitor& monitor, FlipRule rule) {
  constexpr std::size_t kChunk = 64;
  const std::size_t size = blocks.coords.size();
  Topology t;
  t.index = BlockIndex(blocks.coords);
  t.blocks.resize(size);
  t.multiVertex.resize((size + kChunk - 1) / kChunk);
  BlockProgress progress(monitor, "count", size);
  tbb::parallel_for(std::size_t{0}, t.multiVertex.size(), [&](std::size_t chunk) {
    const std::size_t begin = chunk * kChunk, count = std::min(kChunk, size - begin);
    std::vector<MultiVertexCell>& multiVertex = t.multiVertex[chunk];
    std::array<std::size_t, kChunk + 1> firstMultiVertex{};
    LowerBlocks lower(blocks.coords, begin);
    for (std::size_t i = 0; i < count; ++i) {
      BlockTopology& block = t.blocks[begin + i];
      lower.find(begin + i, block.lower);
      BlockCounter(blocks, t.index, rule, begin + i, block, multiVertex).run();
      firstMultiVertex[i + 1] = multiVertex.size();
    }
    for (std::size_t i = 0; i < count; ++i)
      t.blocks[begin + i].multiVertex =
          std::span(multiVertex).subspan(firstMultiVertex[i], firstMultiVertex[i + 1] - firstMultiVertex[i]);
    progress.advance(count);
  });
  for (BlockTopology& b : t.blocks) {
    b.firstVertex = t.vertexCount;
    b.firstQuad = t.quadCount;
    t.vertexCount += b.vertexCount;
    t.quadCount += b.quadCount;
    t.openArcs += b.openArcs;
    for (const MultiVertexCell& s : b.multiVertex) t.multiVertexCells += s.vertexCount > 1;
  }
  return t;
}

void checkVertexCount(std::uint64_t vertices) {
  constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 32;
  if (vertices > kMaxVertices)
    throw Error(
        fmt::format("the mesh would have {} vertices, the limit is {}; use a coarser lattice", vertices, kMaxVertices));
}

}  // namespace pdc::detail
