#include "extract/faces/fill_mesh.h"

#include <tbb/combinable.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "extract/faces/block_faces.h"
#include "extract/faces/block_groups.h"
#include "extract/vertices/vertex_solver.h"
#include "parallel/block_progress.h"

namespace pdc::detail {
namespace {

/// Blocks per thread and window: enough that threads seldom wait for each other, few enough that what faces need of two
/// windows' vertices (about 64 a block, 48 bytes each) stays in a second-level cache.
constexpr std::size_t kWindowBlocks = 128;

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

/// Fills the arrays of a mesh, which have their sizes, window by window.
class MeshFiller {
 public:
  MeshFiller(const HermiteSource& source, const SurfaceBlocks& blocks, const Topology& topology,
             const ContourOptions& options, const SigmaNormal& sigma, Mesh& mesh, bool promised, const Monitor& monitor,
             SimdLevel level)
      : mBlocks(blocks),
        mTopology(topology),
        mMonitor(monitor),
        mPromised(promised),
        mEnds(windowEnds(blocks.coords)),
        mErrors(longestRun(topology, mEnds)),
        mOut{mesh.positions.data(), options.normals ? mesh.normals.data() : nullptr, &mErrors, nullptr},
        mFaces(blocks, topology, source.map(), mesh.quads.data(), level),
        mSolvers(
            [&source, sigma, level, halfSize = options.placement == Placement::kCell ? kCellHalfSize : kFreeHalfSize] {
              return BlockVertexSolver(source, sigma, halfSize, level);
            }),
        mProgress(monitor, "contour", blocks.coords.size()) {}

  VertexCounts run() {
    std::size_t previous = 0, begin = 0;
    for (const std::size_t end : mEnds) {
      mErrors.moveOn(mTopology.blocks[previous].firstVertex);  // Faces reach back into the window before.
      fillWindow(begin, end);
      previous = begin;
      begin = end;
    }
    VertexCounts total;
    mCounts.combine_each([&](const VertexCounts& c) { total += c; });
    return total;
  }

  void appendDoubts(Doubts& doubts) const {
    for (const Doubts& d : mDoubts) doubts.append(d);
    std::sort(doubts.vertices.begin(), doubts.vertices.end(),
              [](const LooseVertex& a, const LooseVertex& b) { return a.vertex < b.vertex; });
    std::sort(doubts.quads.begin(), doubts.quads.end());
  }

 private:
  using FacelessBlocks = std::vector<std::size_t>;

  void fillWindow(std::size_t begin, std::size_t end) {
    BlockGroups groups(mTopology, begin, end);
    tbb::enumerable_thread_specific<FacelessBlocks> waiting;
    tbb::parallel_for(std::size_t{0}, groups.count(), [&](std::size_t) {
      mMonitor.throwIfStopped();
      fillGroup(groups.take(), groups, waiting.local());
    });
    FacelessBlocks rest;
    for (const FacelessBlocks& some : waiting) rest.insert(rest.end(), some.begin(), some.end());
    tbb::parallel_for(std::size_t{0}, rest.size(), [&](std::size_t i) { mFaces.run(rest[i], mErrors, doubts()); });
  }

  /// Solves a group's vertices and writes the faces of those blocks, of it and of `faceless`, whose vertices are all
  /// solved.
  void fillGroup(const BlockGroups::Range& range, BlockGroups& groups, FacelessBlocks& faceless) {
    BlockVertexSolver& solver = mSolvers.local();
    VertexCounts& counts = mCounts.local();
    VertexOutput out = mOut;
    out.doubts = doubts();
    for (std::size_t i = range.begin; i != range.end; ++i) {
      solver.run(i, mBlocks, mTopology, out, counts);
      faceless.push_back(i);
    }
    groups.setSolved(range.group);
    std::erase_if(faceless, [&](std::size_t i) {
      const bool ready = groups.hasItsVertices(i);
      if (ready) mFaces.run(i, mErrors, out.doubts);
      return ready;
    });
    mProgress.advance(range.end - range.begin);
  }

  /// The thread's own, or null.
  [[nodiscard]] Doubts* doubts() { return mPromised ? &mDoubts.local() : nullptr; }

  const SurfaceBlocks& mBlocks;
  const Topology& mTopology;
  const Monitor& mMonitor;
  const bool mPromised;
  const std::vector<std::size_t> mEnds;  ///< Of windows.
  VertexErrors mErrors;
  const VertexOutput mOut;
  const BlockFaceWriter mFaces;
  tbb::enumerable_thread_specific<BlockVertexSolver> mSolvers;
  tbb::enumerable_thread_specific<Doubts> mDoubts;
  tbb::combinable<VertexCounts> mCounts;
  BlockProgress mProgress;
};

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
  const SigmaNormal sigma =
      options.sigmaNormal ? SigmaNormal(*options.sigmaNormal) : SigmaNormal::fromData(source, blocks, monitor);
  MeshFiller filler(source, blocks, topology, options, sigma, mesh, doubts != nullptr, monitor, level);
  VertexCounts counts = filler.run();
  counts.normalNoise = sigma.noise();
  if (doubts != nullptr) filler.appendDoubts(*doubts);
  return counts;
}

}  // namespace pdc::detail
