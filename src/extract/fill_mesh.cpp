#include "extract/fill_mesh.h"

#include <tbb/combinable.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "extract/block_faces.h"
#include "extract/block_progress.h"
#include "extract/vertex_solver.h"

namespace pdc::detail {
namespace {

/// Blocks per thread and window: enough that threads seldom wait for each other, few enough that two windows' vertices
/// (about 64 a block, 48 bytes each) stay in a second-level cache.
constexpr std::size_t kWindowBlocks = 256;

/// Room for the vertices that certifying may add, as a share of all: so that they do not move the rest.
constexpr double kRoomForFans = 1.0 / 256;

/// Ends of windows: runs of whole slabs of blocks with the same x.
std::vector<std::size_t> windowEnds(const std::vector<Coord>& blocks) {
  const std::size_t least = kWindowBlocks * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < blocks.size();) {
    std::size_t end = std::min(begin + least, blocks.size());
    end = static_cast<std::size_t>(std::upper_bound(blocks.begin() + static_cast<std::ptrdiff_t>(end) - 1, blocks.end(),
                                                    blocks[end - 1],
                                                    [](const Coord& a, const Coord& b) { return a[0] < b[0]; }) -
                                   blocks.begin());
    ends.push_back(end);
    begin = end;
  }
  return ends;
}

/// The most vertices that two windows in a row have.
std::size_t longestRun(const Topology& topology, const std::vector<std::size_t>& ends) {
  std::uint64_t most = 0, previous = 0, first = 0;
  for (const std::size_t end : ends) {
    const std::uint64_t next = end < topology.blocks.size() ? topology.blocks[end].firstVertex : topology.vertexCount;
    most = std::max(most, next - previous);
    previous = first;
    first = next;
  }
  return most;
}

}  // namespace

VertexCounts fillMesh(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
                      const ContourOptions& options, Mesh& mesh, Doubts* doubts, const Monitor& monitor,
                      SimdLevel level) {
  if (doubts != nullptr)
    mesh.positions.reserve(topology.vertexCount +
                           static_cast<std::size_t>(kRoomForFans * static_cast<double>(topology.vertexCount)));
  mesh.positions.resize(topology.vertexCount);
  if (options.normals) mesh.normals.resize(topology.vertexCount);
  mesh.quads.resize(topology.quadCount);
  const double halfSize = options.placement == Placement::kCell ? kCellHalfSize : kFreeHalfSize;
  const SigmaNormal sigma =
      options.sigmaNormal ? SigmaNormal(*options.sigmaNormal) : SigmaNormal::fromData(source, blocks, monitor);
  tbb::enumerable_thread_specific<BlockVertexSolver> solvers(
      [&] { return BlockVertexSolver(source, sigma, halfSize, level); });
  tbb::enumerable_thread_specific<Doubts> found;
  tbb::combinable<VertexCounts> counts;
  const BlockFaceWriter faces(blocks, topology, source.map(), mesh.quads.data(), level);
  BlockProgress progress(monitor, "contour", blocks.coords.size());

  const std::vector<std::size_t> ends = windowEnds(blocks.coords);
  VertexErrors errors(longestRun(topology, ends));
  std::size_t previous = 0, begin = 0;
  for (const std::size_t end : ends) {
    errors.moveOn(topology.blocks[previous].firstVertex);  // Faces reach back into the window before.
    const VertexOutput out{mesh.positions.data(), options.normals ? mesh.normals.data() : nullptr, &errors, nullptr};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 16), [&](const auto& range) {
      monitor.throwIfStopped();
      BlockVertexSolver& block = solvers.local();
      VertexCounts& count = counts.local();
      VertexOutput mine = out;
      if (doubts != nullptr) mine.doubts = &found.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) block.run(i, blocks, topology, mine, count);
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 16), [&](const auto& range) {
      Doubts* mine = doubts != nullptr ? &found.local() : nullptr;
      for (std::size_t i = range.begin(); i != range.end(); ++i) faces.run(i, errors, mine);
      progress.advance(range.size());
    });
    previous = begin;
    begin = end;
  }
  if (doubts != nullptr) {
    for (const Doubts& d : found) doubts->append(d);
    std::sort(doubts->vertices.begin(), doubts->vertices.end(),
              [](const LooseVertex& a, const LooseVertex& b) { return a.vertex < b.vertex; });
    std::sort(doubts->quads.begin(), doubts->quads.end());
  }
  VertexCounts total{.normalNoise = sigma.noise()};
  counts.combine_each([&](const VertexCounts& c) { total += c; });
  return total;
}

}  // namespace pdc::detail
