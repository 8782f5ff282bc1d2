#include "extract/faces/block_faces.h"

#include <algorithm>
#include <array>

#include "extract/faces/quad_lanes.h"
#include "extract/topology/cell_vertices.h"
#include "extract/topology/edge_cells.h"
#include "extract/vertices/cell_rounding.h"
#include "math/lane_loops.h"
#include "math/word_bits.h"

namespace pdc::detail {
namespace {

/// Bounds the error of triple products of three places not farther than a cell from a lattice point: what single
/// precision does to their sums, and what rounding the places in world space does.
float volumeErrorBound(const LatticeMap& map, const Coord& block) {
  constexpr double kArithmetic = 1e-5, kPerRounding = 16;
  return static_cast<float>(kArithmetic + kPerRounding * cellRounding(map, block));
}

}  // namespace

/// The quads of a block: each step for all of them, so that they need not wait for each other. Must be compiled into a
/// function of a SimdLevel.
class BlockFaceWriter::Block {
 public:
  Block(const BlockFaceWriter& writer, std::size_t block, const PlacedQuadrics& quadrics, Suspects* suspects)
      : mWriter(writer),
        mOwn(writer.mTopology.blocks[block]),
        mBlock(block),
        mVertices(writer.mTopology, mOwn),
        mQuadrics(quadrics),
        mSuspects(suspects),
        mQuads(writer.mQuads + mOwn.firstQuad),
        mErrorBound(suspects != nullptr ? volumeErrorBound(writer.mMap, writer.mBlocks.coords[block]) : 0.0F) {}

  void run() {
    listEdges();
    if (mVertices.allSimple())
      findVertices<true>();
    else
      findVertices<false>();
    for (int first = 0; first < mBegin[3]; first += kLanes) addSixteen(first, std::min(mBegin[3] - first, kLanes));
  }

 private:
  static constexpr int kMostQuads = 3 * kBlockCells;

  void listEdges() {
    int n = 0;
    for (const Axis axis : kAxes) {
      mBegin[axis] = n;
      for (int x = 0; x < kBlockSize; ++x)
        n += writeBits<4>(mOwn.edges[axis].word[x], [&](int i, int bit) {
          mEdge[n + i] = static_cast<std::uint16_t>(kBlockCells * axis + 64 * x + bit);
        });
    }
    mBegin[3] = n;
  }

  template <bool simple>
  void findVertices() {
    findVertices<kAxisX, simple>();
    findVertices<kAxisY, simple>();
    findVertices<kAxisZ, simple>();
  }

  template <Axis axis, bool simple>
  void findVertices() {
    constexpr int kStepU = CellVertices::kStep[nextAxis(axis)], kStepV = CellVertices::kStep[previousAxis(axis)];
    for (int i = mBegin[axis]; i < mBegin[axis + 1]; ++i) {
      const std::uint32_t* at = mVertices.at({static_cast<std::uint16_t>(mEdge[i] % kBlockCells)});
      for (int k = 0; k < 4; ++k) {
        const std::uint32_t* cell = at - (kCellsAboutEdge[k][0] * kStepU + kCellsAboutEdge[k][1] * kStepV);
        mVertex[k][i] = simple ? *cell : mVertices.vertexAt(cell, edgeInCell(axis, k));
      }
    }
  }

  [[nodiscard]] EdgeRef edge(int i) const { return {static_cast<std::int32_t>(mBlock), mEdge[i]}; }

  /// Chooses diagonals for the first `used` of sixteen quads, and writes them.
  void addSixteen(int first, int used) {
    for (int k = 0; k < 4; ++k) {
      std::uint32_t* const vertex = &mVertex[k][first];
      std::fill(vertex + used, vertex + kLanes, vertex[0]);
      alignas(64) std::uint32_t place[kLanes];
      forEachLane([&place, vertex, index = mQuadrics.index()](int i) { place[i] = index.place(vertex[i]); });
      const PlacedQuadric* quadrics = mQuadrics.data();
      for (int i = 0; i < kLanes; i += 4)
        mLanes.set(k, i,
                   {quadrics + place[i], quadrics + place[i + 1], quadrics + place[i + 2], quadrics + place[i + 3]});
    }
    for (int i = 0; i < kLanes; ++i) mLanes.axis[i] = mEdge[first + i] / kBlockCells;
    chooseDiagonals(mLanes);
    if (mSuspects != nullptr) {
      findPassing(mLanes, mErrorBound);
      for (int i = 0; i < used; ++i)
        if ((mLanes.passes[i] & 1) == 0) noteSuspect(first + i, i);
    }
    write(first, used);
  }

  /// The diagonal of a lane's quad does not pass.
  void noteSuspect(int i, int lane) {
    if ((mLanes.passes[lane] & 2) != 0) {
      mLanes.first[lane] ^= 1;
      ++mSuspects->forcedDiagonals;
    } else {
      mSuspects->quads.push_back(edge(i));
    }
  }

  /// Quads start where their diagonal does, and go round as their orientation wants.
  void write(int from, int used) {
    const BlockSigns& signs = mWriter.mBlocks.signs[mBlock];
    const bool mirrored = mWriter.mMap.mirrored();
    alignas(64) std::uint32_t reversed[kLanes], quad[4][kLanes];
    for (int i = 0; i < kLanes; ++i) {
      const EdgeRef e = edge(from + i);
      reversed[i] = signs.inside(e.x(), e.y(), e.z()) == mirrored ? 1 : 0;
    }
    forEachLane([&, first = mLanes.first, v0 = &mVertex[0][from], v1 = &mVertex[1][from], v2 = &mVertex[2][from],
                 v3 = &mVertex[3][from]](int i) {
      const bool same = first[i] != 0, back = reversed[i] != 0;
      const std::uint32_t next = same ? v1[i] : v2[i], last = same ? v3[i] : v0[i];
      quad[0][i] = same ? v0[i] : v1[i];
      quad[1][i] = back ? last : next;
      quad[2][i] = same ? v2[i] : v3[i];
      quad[3][i] = back ? next : last;
    });
    for (int i = 0; i < used; ++i) mQuads[from + i] = {quad[0][i], quad[1][i], quad[2][i], quad[3][i]};
  }

  const BlockFaceWriter& mWriter;
  const BlockTopology& mOwn;
  const std::size_t mBlock;
  const CellVertices mVertices;
  const PlacedQuadrics& mQuadrics;
  Suspects* const mSuspects;
  Quad* const mQuads;
  const float mErrorBound;
  QuadLanes mLanes;
  std::array<int, 4> mBegin{};  ///< Per axis, the first of its edges in the lists.
  // Not cleared: a block uses little of them.
  std::array<std::uint16_t, kMostQuads + kLanes> mEdge;
  std::array<std::array<std::uint32_t, kMostQuads + kLanes>, 4> mVertex;
};

void BlockFaceWriter::run(std::size_t block, const PlacedQuadrics& quadrics, Suspects* suspects) const {
  withSimd(mLevel, [&] { Block(*this, block, quadrics, suspects).run(); });
}

}  // namespace pdc::detail
