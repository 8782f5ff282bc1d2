#include <fmt/format.h>

#include <cstdio>

#include "commands/slabs/slab_commands.h"
#include "files/json_file.h"
#include "parallel/stopwatch.h"
#include "pdc/tile/slab_folder.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"
#include "tiles/contour_in_slabs.h"
#include "tiles/planned_request.h"

namespace pdc {

void runMerge(const SlabsRequest& request) {
  checkJsonPath(request.json);
  checkSlabs(request.output, {});
  detail::Stopwatch stopwatch;
  const SlabFolder folder(request.folder);
  const PlannedRequest planned = plannedRequest(folder.request());
  ProgressBar bar(!request.quiet);
  const SlabMergeReport report = mergeSlabs(
      folder, request.output, planned.mesh.triangles, writeOptions(planned),
      {.progress = [&bar](const char* stage, double share) { bar.update(stage, share); }, .stop = &interruptFlag()});
  if (report.vertices == 0) {
    const std::string message = fmt::format("{} has no surface; the mesh is empty", planned.mesh.input.string());
    if (planned.mesh.requireSurface) throw Error(message);
    printWarning(message);
  }
  const double seconds = stopwatch.lap();
  writeJson({{"folder", request.folder.string()},
             {"output", shownPath(request.output)},
             {"slabs", folder.plan().slabs.size()},
             {"vertices", report.vertices},
             {"quads", report.quads},
             {"triangles", report.triangles},
             {"boundary_edges", report.boundaryEdges},
             {"blocks", report.blocks},
             {"multi_vertex_cells", report.multiVertexCells},
             {"added_vertices", report.added},
             {"uncertified_pairs", report.uncertified},
             {"bytes_written", report.bytesWritten},
             {"seconds", seconds}},
            request.json);
  if (request.quiet || request.json == "-") return;
  fmt::print("{}: {} vertices, {} quads and {} triangles of {} slabs; {} bytes; {:.2f} s\n", shownPath(request.output),
             report.vertices, report.quads, report.triangles, folder.plan().slabs.size(), report.bytesWritten, seconds);
}

}  // namespace pdc
