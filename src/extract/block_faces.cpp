#include "extract/block_faces.h"

#include <algorithm>
#include <array>
#include <bit>

#include "extract/cell_rounding.h"
#include "extract/cell_vertices.h"
#include "extract/quad_lanes.h"
#include "extract/quad_rings.h"
#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// Of triple products of three places not farther than a cell from a lattice point: what single precision does to
/// their sums, and what rounding the places in world space does.
float volumeDoubt(const LatticeMap& map, const Coord& block) {
  constexpr double kArithmetic = 1e-5, kPerRounding = 16;
  return static_cast<float>(kArithmetic + kPerRounding * cellRounding(map, block));
}

}  // namespace

/// The quads of a block, sixteen at a time. Must be compiled into a function of a SimdLevel.
class BlockFaceWriter::Block {
 public:
  Block(const BlockFaceWriter& writer, std::size_t block, const CellVertices& vertices, const VertexErrors& errors,
        Doubts* doubts, Quad* quads)
      : mWriter(writer),
        mBlock(block),
        mSigns(writer.mBlocks.signs[block]),
        mMirrored(writer.mMap.mirrored()),
        mVertices(vertices),
        mErrors(errors),
        mDoubts(doubts),
        mQuads(quads),
        mDoubt(doubts != nullptr ? volumeDoubt(writer.mMap, writer.mBlocks.coords[block]) : 0.0F) {}

  void run() {
    addAxis<0>();
    addAxis<1>();
    addAxis<2>();
    if (mUsed != 0) flush();
  }

 private:
  template <int axis>
  void addAxis() {
    const CellMask& edges = mWriter.mTopology.blocks[mBlock].edges[axis];
    for (int x = 0; x < kBlockSize; ++x)
      for (std::uint64_t w = edges.word[x]; w != 0; w &= w - 1) {
        add<axis>(x, std::countr_zero(w));
        if (mUsed == kLanes) flush();
      }
  }

  template <int axis>
  void add(int x, int bit) {
    constexpr int kStepU = CellVertices::kStep[(axis + 1) % 3], kStepV = CellVertices::kStep[(axis + 2) % 3];
    const int y = bit >> 3, z = bit & 7;
    mEdge[mUsed] = static_cast<std::uint16_t>(512 * axis + 64 * x + bit);
    mReversed[mUsed] = mSigns.inside(x, y, z) == mMirrored ? 1 : 0;
    mLanes.axis[mUsed] = axis;
    if (mVertices.allSimple()) {
      const std::uint32_t* at = mVertices.at(x, y, z);
      for (int k = 0; k < 4; ++k) mLanes.vertex[k][mUsed] = at[-(kRing[k][0] * kStepU + kRing[k][1] * kStepV)];
    } else {
      const Quad ring = QuadRings(mWriter.mBlocks, mWriter.mTopology).vertices(edge(mUsed));
      for (int k = 0; k < 4; ++k) mLanes.vertex[k][mUsed] = ring[k];
    }
    ++mUsed;
  }

  [[nodiscard]] EdgeRef edge(int lane) const { return {static_cast<std::int32_t>(mBlock), mEdge[lane]}; }

  void flush() {
    for (int k = 0; k < 4; ++k) {
      std::uint32_t* const vertex = mLanes.vertex[k];
      std::fill(vertex + mUsed, vertex + kLanes, vertex[0]);
      for (int i = 0; i < kLanes; i += 4)
        mLanes.set(k, i,
                   {&mErrors[vertex[i]], &mErrors[vertex[i + 1]], &mErrors[vertex[i + 2]], &mErrors[vertex[i + 3]]});
    }
    chooseDiagonals(mLanes);
    if (mDoubts != nullptr) {
      findPassing(mLanes, mDoubt);
      for (int i = 0; i < mUsed; ++i)
        if ((mLanes.passes[i] & 1) == 0) noteDoubt(i);
    }
    write();
  }

  /// The diagonal of a lane's quad does not pass.
  void noteDoubt(int lane) {
    if ((mLanes.passes[lane] & 2) != 0) {
      mLanes.first[lane] ^= 1;
      ++mDoubts->forcedDiagonals;
    } else {
      mDoubts->quads.push_back(edge(lane));
    }
  }

  /// Quads start where their diagonal does, and go round as their orientation wants.
  void write() {
    alignas(64) std::uint32_t quad[4][kLanes];
    forEachLane([&](int i) {
      const bool first = mLanes.first[i] != 0, reversed = mReversed[i] != 0;
      const auto& v = mLanes.vertex;
      const std::uint32_t start = first ? v[0][i] : v[1][i], next = first ? v[1][i] : v[2][i],
                          across = first ? v[2][i] : v[3][i], last = first ? v[3][i] : v[0][i];
      quad[0][i] = start;
      quad[1][i] = reversed ? last : next;
      quad[2][i] = across;
      quad[3][i] = reversed ? next : last;
    });
    for (int i = 0; i < mUsed; ++i) mQuads[i] = {quad[0][i], quad[1][i], quad[2][i], quad[3][i]};
    mQuads += mUsed;
    mUsed = 0;
  }

  const BlockFaceWriter& mWriter;
  const std::size_t mBlock;
  const BlockSigns& mSigns;
  const bool mMirrored;
  const CellVertices& mVertices;
  const VertexErrors& mErrors;
  Doubts* const mDoubts;
  Quad* mQuads;
  const float mDoubt;
  int mUsed = 0;
  QuadLanes mLanes;
  alignas(64) std::array<std::uint32_t, kLanes> mReversed;
  std::array<std::uint16_t, kLanes> mEdge;
};

void BlockFaceWriter::run(std::size_t block, const VertexErrors& errors, Doubts* doubts) const {
  forEachBlock(mLevel, 1, [&](std::size_t) {
    const BlockTopology& own = mTopology.blocks[block];
    const CellVertices vertices(mTopology, own);
    Block(*this, block, vertices, errors, doubts, mQuads + own.firstQuad).run();
  });
}

}  // namespace pdc::detail
