#include "extract/vertex_quadrics.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <vector>

#include "extract/vertices/block_sampler.h"
#include "extract/vertices/crossing_planes.h"
#include "extract/vertices/patch_solver.h"
#include "mesh/faces.h"
#include "parallel/block_progress.h"
#include "parallel/isolated.h"

namespace pdc::detail {
namespace {

Quadric<float> toFloat(const Quadric<double>& q) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {{f(q.A.xx), f(q.A.xy), f(q.A.xz), f(q.A.yy), f(q.A.yz), f(q.A.zz)}, vecCast<float>(q.b), f(q.c)};
}

Quadric<double> toDouble(const Quadric<float>& q) {
  const auto d = [](float v) { return static_cast<double>(v); };
  return {{d(q.A.xx), d(q.A.xy), d(q.A.xz), d(q.A.yy), d(q.A.yz), d(q.A.zz)}, vecCast<double>(q.b), d(q.c)};
}

/// The quadrics of one block's vertices after another. For one thread; large: keep it off the stack.
class BlockQuadrics {
 public:
  BlockQuadrics(const HermiteSource& source, const SigmaNormal& sigma)
      : mMap(source.map()),
        mSolver(sigma, kFreeHalfSize),
        mSampler(source, sigma.needsNoise()),
        mPatchSolver(mSampler, mCrossings, mSolver) {}

  void run(const SurfaceBlock& block, const BlockTopology& topology, const Mesh& mesh, Buffer<Quadric<float>>& out) {
    const Vec3d origin = blockOrigin(block.coord);
    const CellMetric metric = blockMetric(mMap, origin);
    const double unit = metric.voxelSize * metric.voxelSize;
    mSampler.run(block, topology, metric);
    mSolver.setNoise(mSampler.normalNoise());
    mCrossings.fill(mSampler.hermite(), block.edges, metric, mMap, origin, bestSimdLevel());
    for (std::size_t i = 0; i < mSampler.patches().size(); ++i) {
      mPatchSolver.load(i, block.edges);
      const Vec3d center = origin + cellCenter(mSampler.patches()[i].cell);
      const Mat3d toLattice = inverse(mMap.jacobian(center));
      const std::uint64_t vertex = topology.firstVertex + i;
      const Vec3d place = toLattice * (vecCast<double>(mesh.positions[vertex]) - mMap.position(center));
      const Quadric<double> q = mSolver.quadric(mPatchSolver.samples(), metric).q;
      out[vertex] = toFloat(q.relativeTo(place).pullback(toLattice, {}) * unit);
    }
  }

 private:
  const LatticeMap& mMap;
  VertexSolver mSolver;
  BlockSampler mSampler;
  CrossingPlanes mCrossings;
  PatchSolver mPatchSolver;
};

/// Vertices that certifying added have no patch of their own: each gets the mean of its neighbours' quadrics.
void fillAdded(const Mesh& mesh, std::size_t solved, Buffer<Quadric<float>>& quadrics) {
  if (solved == quadrics.size()) return;
  std::vector<Quadric<double>> sum(quadrics.size() - solved, Quadric<double>::zero());
  std::vector<double> count(sum.size(), 0);
  for (std::size_t f = 0; f < faceCount(mesh); ++f)
    for (const std::uint32_t a : face(mesh, f)) {
      if (a < solved) continue;
      for (const std::uint32_t b : face(mesh, f)) {
        if (b >= solved) continue;
        const Vec3d step = vecCast<double>(mesh.positions[a]) - vecCast<double>(mesh.positions[b]);
        sum[a - solved] += toDouble(quadrics[b]).relativeTo(step);
        count[a - solved] += 1;
      }
    }
  for (std::size_t i = 0; i < sum.size(); ++i)
    quadrics[solved + i] = toFloat(count[i] > 0 ? sum[i] * (1 / count[i]) : sum[i]);
}

}  // namespace

Buffer<Quadric<float>> vertexQuadrics(const Surface& surface, const SigmaNormal& sigma, const Mesh& mesh,
                                      const Monitor& monitor) {
  const HermiteSource& source = surface.source;
  const SurfaceBlocks& blocks = surface.blocks;
  const Topology& topology = surface.topology;
  Buffer<Quadric<float>> quadrics(mesh.positions.size());
  tbb::enumerable_thread_specific<std::unique_ptr<BlockQuadrics>> workers(
      [&] { return std::make_unique<BlockQuadrics>(source, sigma); });
  BlockProgress progress(monitor, "quadrics", blocks.coords.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.coords.size(), 16), [&](const auto& range) {
    isolated([&] {
      BlockQuadrics& worker = *workers.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const EdgeIndex edges(blocks.signs[i]);
        worker.run({blocks.coords[i], blocks.signs[i], edges}, topology.blocks[i], mesh, quadrics);
      }
    });
    progress.advance(range.size());
  });
  fillAdded(mesh, topology.vertexCount, quadrics);
  return quadrics;
}

}  // namespace pdc::detail
