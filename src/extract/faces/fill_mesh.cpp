#include "extract/faces/fill_mesh.h"

#include <tbb/combinable.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>
#include <vector>

#include "extract/faces/block_faces.h"
#include "extract/faces/block_groups.h"
#include "parallel/block_progress.h"
#include "parallel/isolated.h"

namespace pdc::detail {
namespace {

/// Blocks per thread and run of slabs: enough that threads seldom wait for each other, few enough that what faces need
/// of two runs of slabs' vertices (about 64 a block, 48 bytes each) stays in a second-level cache.
constexpr std::size_t kSlabRunBlocks = 128;

/// Room for the vertices that certifying may add, as a share of all: so that they do not move the rest.
constexpr double kRoomForFans = 1.0 / 256;

/// Ends of runs of whole slabs, the blocks with the same x.
std::vector<std::size_t> slabRunEnds(const std::vector<Coord>& blocks) {
  const std::size_t least = kSlabRunBlocks * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
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

/// The most vertices that two runs of slabs in a row have.
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

/// Fills the arrays of a mesh, which have their sizes, a run of slabs after the other.
class MeshFiller {
 public:
  MeshFiller(const Surface& surface, const FillMeshOptions& options, Mesh& mesh, bool noteSuspects,
             const Monitor& monitor)
      : mSurface(surface),
        mMonitor(monitor),
        mNoteSuspects(noteSuspects),
        mEnds(slabRunEnds(surface.blocks.coords)),
        mQuadrics(longestRun(surface.topology, mEnds)),
        mOut{mesh.positions.data(), options.normals ? mesh.normals.data() : nullptr, &mQuadrics, nullptr},
        mFaces(surface, mesh.quads.data(), options.level),
        mSolvers([&surface, &options] {
          return BlockVertexSolver(surface.source, options.sigma, options.halfSize, options.level);
        }),
        mProgress(monitor, "contour", surface.blocks.coords.size()) {}

  VertexCounts run() {
    std::size_t previous = 0, begin = 0;
    for (const std::size_t end : mEnds) {
      mQuadrics.moveOn(
          mSurface.topology.blocks[previous].firstVertex);  // Faces reach back into the run of slabs before.
      fillSlabRun(begin, end);
      previous = begin;
      begin = end;
    }
    VertexCounts total;
    mCounts.combine_each([&](const VertexCounts& c) { total += c; });
    return total;
  }

  void collectSuspects(Suspects& suspects) const {
    suspects.vertices = inBlockOrder(&Suspects::vertices);
    suspects.quads = inBlockOrder(&Suspects::quads);
    for (const Suspects& s : mSuspects) suspects.forcedDiagonals += s.forcedDiagonals;
  }

 private:
  using FacelessBlocks = std::vector<std::size_t>;

  /// What the threads noted, each block in one piece, one block after the other.
  template <typename T>
  [[nodiscard]] std::vector<T> inBlockOrder(std::vector<T> Suspects::*list) const {
    struct Piece {
      std::int32_t block;
      std::span<const T> part;
      std::size_t at = 0;
    };
    std::vector<Piece> pieces;
    for (const Suspects& s : mSuspects) {
      const std::vector<T>& own = s.*list;
      for (auto begin = own.begin(); begin != own.end();) {
        const auto end = std::find_if(begin, own.end(), [&](const auto& e) { return e.block != begin->block; });
        pieces.push_back({begin->block, {begin, end}});
        begin = end;
      }
    }
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.block < b.block; });
    std::size_t size = 0;
    for (Piece& p : pieces) {
      p.at = size;
      size += p.part.size();
    }
    std::vector<T> all(size);
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
      std::copy(pieces[i].part.begin(), pieces[i].part.end(), all.begin() + static_cast<std::ptrdiff_t>(pieces[i].at));
    });
    return all;
  }

  void fillSlabRun(std::size_t begin, std::size_t end) {
    BlockGroups groups(mSurface.topology, begin, end);
    tbb::enumerable_thread_specific<FacelessBlocks> waiting;
    tbb::parallel_for(std::size_t{0}, groups.count(), [&](std::size_t) {
      mMonitor.throwIfStopped();
      isolated([&] { fillGroup(groups.take(), groups, waiting.local()); });
    });
    FacelessBlocks rest;
    for (const FacelessBlocks& some : waiting) rest.insert(rest.end(), some.begin(), some.end());
    tbb::parallel_for(std::size_t{0}, rest.size(), [&](std::size_t i) { mFaces.run(rest[i], mQuadrics, suspects()); });
  }

  /// Solves a group's vertices and writes the faces of those blocks, of it and of `faceless`, whose vertices are all
  /// solved.
  void fillGroup(const BlockGroups::Range& range, BlockGroups& groups, FacelessBlocks& faceless) {
    BlockVertexSolver& solver = mSolvers.local();
    VertexCounts& counts = mCounts.local();
    VertexOutput out = mOut;
    out.suspects = suspects();
    for (std::size_t i = range.begin; i != range.end; ++i) {
      solver.run(i, mSurface, out, counts);
      faceless.push_back(i);
    }
    groups.setSolved(range.group);
    std::erase_if(faceless, [&](std::size_t i) {
      const bool ready = groups.hasItsVertices(i);
      if (ready) mFaces.run(i, mQuadrics, out.suspects);
      return ready;
    });
    mProgress.advance(range.end - range.begin);
  }

  /// The thread's own, or null.
  [[nodiscard]] Suspects* suspects() { return mNoteSuspects ? &mSuspects.local() : nullptr; }

  const Surface& mSurface;
  const Monitor& mMonitor;
  const bool mNoteSuspects;
  const std::vector<std::size_t> mEnds;  ///< Where runs of slabs end.
  PlacedQuadrics mQuadrics;
  const VertexOutput mOut;
  const BlockFaceWriter mFaces;
  tbb::enumerable_thread_specific<BlockVertexSolver> mSolvers;
  tbb::enumerable_thread_specific<Suspects> mSuspects;
  tbb::combinable<VertexCounts> mCounts;
  BlockProgress mProgress;
};

}  // namespace

VertexCounts fillMesh(const Surface& surface, const FillMeshOptions& options, Mesh& mesh, Suspects* suspects,
                      const Monitor& monitor) {
  const Topology& topology = surface.topology;
  if (suspects != nullptr)
    mesh.positions.reserve(topology.vertexCount +
                           static_cast<std::size_t>(kRoomForFans * static_cast<double>(topology.vertexCount)));
  mesh.positions.resize(topology.vertexCount);
  if (options.normals) mesh.normals.resize(topology.vertexCount);
  mesh.quads.resize(topology.quadCount);
  MeshFiller filler(surface, options, mesh, suspects != nullptr, monitor);
  const VertexCounts counts = filler.run();
  if (suspects != nullptr) filler.collectSuspects(*suspects);
  return counts;
}

}  // namespace pdc::detail
