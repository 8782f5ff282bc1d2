#include "commands/pictures/view_command.h"

#include <fmt/format.h>

#include "files/mesh_file.h"
#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/study/view_page.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/progress_bar.h"
#include "terminal/view_option.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

Mesh read(const std::filesystem::path& path, bool quiet) {
  const ExitOnInterrupt scope;
  const BusySign sign(!quiet, "reading " + path.filename().string());
  return readMeshFile(path, quiet).mesh;
}

ViewPageReport write(const ViewRequest& request, const Mesh& mesh, const Mesh* reference) {
  try {
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    return writeViewPage(mesh, request.page,
                         {.title = request.title.empty() ? request.mesh.filename().string() : request.title,
                          .towardsViewer = request.towardsViewer,
                          .reference = reference},
                         {.progress = show, .stop = &interruptFlag()});
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", request.mesh.string(), error.what()));
  }
}

}  // namespace

void addViewOptions(CLI::App& command, ViewRequest& request) {
  command.add_option("MESH", request.mesh, "A mesh, as `pdc info` reads it")->required()->type_name("");
  command.add_option("OUT", request.page, ".html")->required()->type_name("");
  command
      .add_option("--reference", request.reference,
                  "A mesh to lay over it (none); colours show the distance\n"
                  "to it, in world units")
      ->type_name("MESH");
  command.add_option("--title", request.title, "The page's heading (the mesh's file name)")->type_name("TEXT");
  addView(command, request.towardsViewer);
  command.add_flag("--quiet", request.quiet, "No summary, no progress bar, no warnings");
  addThreads(command, request.threads);
  command.footer("Example: pdc view part.ply part.html --reference scan.stl");
}

void runView(const ViewRequest& request) {
  checkViewPagePath(request.page);
  const Mesh mesh = read(request.mesh, request.quiet);
  const Mesh reference = request.reference.empty() ? Mesh{} : read(request.reference, request.quiet);
  const ViewPageReport report = detail::withThreads(request.threads.value_or(0), [&] {
    return write(request, mesh, request.reference.empty() ? nullptr : &reference);
  });
  if (request.quiet) return;
  if (report.lostFaces > 0)
    printWarning(fmt::format("{} faces with a corner that is not finite are left out", report.lostFaces));
  fmt::print("{}: {} triangles, {} bytes\n", request.page.string(), report.triangles, report.bytes);
}

}  // namespace pdc
