#include "extract/block_vertices.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "extract/block_progress.h"

namespace pdc::detail {
namespace {

Vec3d toVec3d(const Coord& c) { return {double(c[0]), double(c[1]), double(c[2])}; }

/// Position of an edge's low corner from the centre of the cell.
constexpr auto kEdgeBase = [] {
  std::array<Vec3d, kEdges> base{};
  for (int e = 0; e < kEdges; ++e) {
    const int low = edgeLowCorner(e);
    base[e] = {(low & 1) - 0.5, (low >> 1 & 1) - 0.5, (low >> 2) - 0.5};
  }
  return base;
}();

/// Solves the vertices of one block after another, reusing its scratch space.
class BlockVertexSolver {
 public:
  BlockVertexSolver(const HermiteSource& source, const VertexSolver& solver, const VertexOutput& out,
                    VertexCounts& counts)
      : mSource(source), mMap(source.map()), mSolver(solver), mOut(out), mCounts(counts) {}

  void run(const Coord& block, const BlockSigns& signs, const BlockTopology& topology) {
    const EdgeIndex edges(signs);
    mSource.fillHermite(block, signs, edges, mHermite);
    mOrigin = toVec3d({block[0] * kBlockSize, block[1] * kBlockSize, block[2] * kBlockSize});
    const CellMetric metric = blockMetric();
    fillRows(edges, metric);
    mCounts.crossings += topology.quadCount;

    std::uint64_t vertex = topology.firstVertex;
    for (int x = 0; x < kBlockSize; ++x)
      for (std::uint64_t w = topology.cells.word[x]; w != 0; w &= w - 1) {
        const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
        const unsigned present = kCellTable[cellCode(signs, x, y, z)].edges;
        const SpecialCell* special = topology.special.empty() ? nullptr : topology.findSpecial(64 * x + bit);
        if (special == nullptr) {
          solveOne(edges, metric, {x, y, z}, present, vertex++);
        } else {
          for (int v = 0; v < special->vertexCount; ++v)
            solveOne(edges, metric, {x, y, z}, patchEdges(*special, present, v), vertex++);
        }
      }
  }

 private:
  /// The sign-changing edges of the patch that vertex v of a special cell belongs to.
  static unsigned patchEdges(const SpecialCell& special, unsigned present, int v) {
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

  /// Only a map that is not affine has a metric that changes from block to block; within one it is taken as constant.
  CellMetric blockMetric() const {
    if (mMap.affine()) return CellMetric(mMap.jacobian({}), mMap.voxelSize());
    constexpr double kMiddle = kBlockSize / 2.0;
    const Mat3d J = mMap.jacobian(mOrigin + Vec3d{kMiddle, kMiddle, kMiddle});
    return CellMetric(J, std::cbrt(std::abs(J.determinant())));
  }

  void fillRows(const EdgeIndex& edges, const CellMetric& metric) {
    edges.forEach([&](int i, int axis, int x, int y, int z) {
      const Vec3d n{mHermite.nx[i], mHermite.ny[i], mHermite.nz[i]};
      const bool owned = x < kBlockSize && y < kBlockSize && z < kBlockSize;
      mCounts.withoutNormal += owned && n == Vec3d{};
      if (metric.identity) return;
      if (mMap.affine()) {
        mRow[i] = metric.M.transposed() * n;
      } else {
        Vec3d p = mOrigin + Vec3d{double(x), double(y), double(z)};
        p[axis] += mHermite.t[i];
        mRow[i] = mMap.jacobian(p).transposed() * n * (1 / metric.voxelSize);
      }
    });
  }

  void solveOne(const EdgeIndex& edges, const CellMetric& metric, const Coord& cell, unsigned present,
                std::uint64_t vertex) {
    mSamples.size = 0;
    Vec3d normal{};
    for (unsigned bits = present; bits != 0; bits &= bits - 1) {
      const int e = std::countr_zero(bits), low = edgeLowCorner(e), axis = edgeAxis(e);
      const int i = edges(axis, cell[0] + (low & 1), cell[1] + (low >> 1 & 1), cell[2] + (low >> 2));
      Vec3d& p = mSamples.position[mSamples.size];
      p = kEdgeBase[e];
      p[axis] += mHermite.t[i];
      const Vec3d n{mHermite.nx[i], mHermite.ny[i], mHermite.nz[i]};
      mSamples.row[mSamples.size++] = metric.identity ? n : mRow[i];
      normal += n;
    }
    const SolvedVertex v = mSolver.solve(mSamples, metric);
    mCounts.outOfCell += v.outOfCell;
    mCounts.moved += v.moved;
    const Vec3d center = mOrigin + toVec3d(cell) + Vec3d{0.5, 0.5, 0.5};
    mOut.positions[vertex] = vecCast<float>(mMap.position(center + v.x));
    mOut.errors[vertex] = {vecCast<float>(v.x),
                           {float(v.A.xx), float(v.A.xy), float(v.A.xz), float(v.A.yy), float(v.A.yz), float(v.A.zz)},
                           vecCast<float>(v.halfGradient)};
    if (mOut.normals != nullptr) {
      const double l = length(normal);
      mOut.normals[vertex] = vecCast<float>(l > 0 ? normal * (1 / l) : Vec3d{});
    }
  }

  const HermiteSource& mSource;
  const LatticeMap& mMap;
  const VertexSolver& mSolver;
  const VertexOutput& mOut;
  VertexCounts& mCounts;
  Vec3d mOrigin{};
  PatchSamples mSamples;
  HermiteBlock mHermite;
  std::array<Vec3d, EdgeIndex::kMaxEdges> mRow;
};

}  // namespace

VertexCounts solveVertices(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                           const VertexSolver& solver, const VertexOutput& out, const Monitor& monitor) {
  BlockProgress progress(monitor, "solve", blocks.coords.size());
  std::atomic<std::size_t> crossings{0}, withoutNormal{0}, outOfCell{0}, moved{0};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.coords.size(), 16), [&](const auto& range) {
    VertexCounts counts;
    BlockVertexSolver block(source, solver, out, counts);
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      monitor.throwIfStopped();
      block.run(blocks.coords[i], blocks.signs[i], topology.blocks[i]);
    }
    crossings += counts.crossings;
    withoutNormal += counts.withoutNormal;
    outOfCell += counts.outOfCell;
    moved += counts.moved;
    progress.advance(range.size());
  });
  return {crossings, withoutNormal, outOfCell, moved};
}

}  // namespace pdc::detail
