#include <algorithm>
#include <optional>
#include <stdexcept>

#include "extract/contour_memory.h"
#include "parallel/with_threads.h"
#include "pdc/tile/slab_folder.h"
#include "tile/slab_agreement.h"
#include "tile/slab_file.h"
#include "tile/slab_lock.h"

namespace pdc {
namespace {

using detail::SlabFile;

/// Contours slabs of one folder.
class SlabRunner {
 public:
  SlabRunner(const SlabFolder& folder, const HermiteSource& source, const SlabRunOptions& options,
             const Monitor& monitor)
      : mFolder(folder), mSource(source), mOptions(options), mMonitor(monitor) {
    mContour = options.contour;
    mContour.triangles = false;
    mContour.origin.reset();
    mContour.exactSums = false;
    const std::size_t count = folder.plan().slabs.size();
    mFirst = options.first.value_or(0);
    mLast = std::min(options.last.value_or(count), count - 1);
    if (mFirst >= count || mFirst > mLast)
      throw Error(detail::slabRangeText(mFirst, options.last.value_or(count - 1), count));
  }

  SlabRunReport run() {
    SlabRunReport report;
    for (;;) {
      const std::optional<Task> task = takeNext(report);
      if (!task) return report;
      contour(*task);
      ++report.contoured;
      report.widened += task->widens;
      if (mOptions.onlyOne) return report;
    }
  }

 private:
  struct Task {
    std::size_t slab;
    int halo;
    bool widens;
    detail::SlabLock lock;
  };

  /// The first slab that has to be contoured and that nobody else has taken.
  std::optional<Task> takeNext(SlabRunReport& report) const {
    report.left = 0;
    for (std::size_t slab = mFirst; slab <= mLast; ++slab) {
      mMonitor.throwIfStopped();
      if (!detail::wantedHalo(mFolder, slab)) continue;
      std::optional<detail::SlabLock> lock = detail::SlabLock::take(mFolder.lockFile(slab));
      if (!lock) {
        ++report.left;
        continue;
      }
      // Somebody may have finished it in between.
      if (const std::optional<int> halo = detail::wantedHalo(mFolder, slab))
        return Task{slab, *halo, *halo > detail::kLeastHalo, std::move(*lock)};
    }
    return std::nullopt;
  }

  void contour(const Task& task) {
    if (!mBlocks) mBlocks = mSource.surfaceBlocks(mMonitor);
    const Slab& s = mFolder.plan().slabs[task.slab];
    detail::giveBackMemory();  // That of the slab before.
    detail::MeshSlab slab =
        detail::contourSlab(mSource, *mBlocks,
                            {.layers = {s.begin, s.end},
                             .halo = task.halo,
                             .place = {.origin = mFolder.plan().origin, .step = mFolder.plan().step}},
                            mContour, mMonitor);
    if (mOptions.finish) mOptions.finish(slab.mesh);
    const detail::SlabHeader header{.plan = mFolder.hash(),
                                    .slab = task.slab,
                                    .halo = task.halo,
                                    .own = slab.own,
                                    .layerBefore = slab.layerBefore,
                                    .lastLayer = slab.lastLayer,
                                    .low = slab.low,
                                    .high = slab.high,
                                    .blocks = slab.blocks,
                                    .multiVertexCells = slab.multiVertexCells,
                                    .boundaryEdges = slab.boundaryEdges,
                                    .uncertified = slab.uncertified,
                                    .quads = slab.mesh.quads.size(),
                                    .triangles = slab.mesh.triangles.size()};
    detail::writeSlabFile(mFolder.slabFile(task.slab), slab, header);
  }

  const SlabFolder& mFolder;
  const HermiteSource& mSource;
  const SlabRunOptions& mOptions;
  const Monitor& mMonitor;
  ContourOptions mContour;
  std::size_t mFirst, mLast;
  std::optional<SurfaceBlocks> mBlocks;
};

}  // namespace

SlabRunReport runSlabs(const SlabFolder& folder, const HermiteSource& source, const SlabRunOptions& options,
                       const Monitor& monitor) {
  if (options.contour.adaptive || options.contour.quadrics)
    throw std::invalid_argument("runSlabs: adaptive distances and quadrics are for whole meshes");
  if (folder.plan().slabs.empty()) return {};
  return detail::withThreads(options.contour.threads,
                             [&] { return SlabRunner(folder, source, options, monitor).run(); });
}

}  // namespace pdc
