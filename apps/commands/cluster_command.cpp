#include "commands/cluster_command.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "parallel/machine_memory.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/io/mesh/cluster_file.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "requests/quadric_words.h"
#include "terminal/busy_sign.h"
#include "terminal/choice_option.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

/// What one run did, as far as the library does not say it. Seconds are wall-clock time.
struct ClusterRun {
  ClusterOptions options;
  ClusterReport report;
  std::size_t bytesWritten = 0;
  double secondsCluster = 0, secondsWrite = 0;
  std::vector<std::string> warnings;
};

Json toJson(const ClusterRequest& request, const ClusterRun& run) {
  const ClusterReport& r = run.report;
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"cell", run.options.cell},
          {"quadric", wordOf(kQuadricWords, run.options.quadric)},
          {"sigma_n", run.options.sigmaNormal},
          {"sigma_p", run.options.sigmaPosition},
          {"triangles_before", r.trianglesBefore},
          {"triangles", r.trianglesAfter},
          {"vertices", r.vertices},
          {"welded_vertices", r.weldedVertices},
          {"cells", r.cells},
          {"collapsed_triangles", r.collapsedTriangles},
          {"non_finite_triangles", r.nonFiniteTriangles},
          {"folded_faces", r.foldedFaces},
          {"duplicate_faces", r.duplicateFaces},
          {"outside_vertices", r.outsideVertices},
          {"bytes", run.bytesWritten},
          {"peak_memory_bytes", detail::peakMemory()},
          {"seconds", {{"cluster", run.secondsCluster}, {"write", run.secondsWrite}}},
          {"warnings", run.warnings}};
}

void printSummary(const ClusterRequest& request, const ClusterRun& run) {
  const ClusterReport& r = run.report;
  fmt::print("{}: {} of {} triangles, {} vertices; {} bytes\n", shownPath(request.output), r.trianglesAfter,
             r.trianglesBefore, r.vertices, run.bytesWritten);
  if (run.options.clean) fmt::print("{} folded and {} duplicate triangles dropped\n", r.foldedFaces, r.duplicateFaces);
  fmt::print("{:.2f} s: reading and clustering {:.2f}, writing {:.2f}\n", run.secondsCluster + run.secondsWrite,
             run.secondsCluster, run.secondsWrite);
}

/// What the user should know of, one line each.
std::vector<std::string> warningsOf(const ClusterReport& r) {
  std::vector<std::string> warnings;
  if (r.nonFiniteTriangles > 0)
    warnings.push_back(fmt::format("{} triangles are not finite and are left out", r.nonFiniteTriangles));
  if (r.trianglesAfter == 0 && r.trianglesBefore > 0)
    warnings.push_back(fmt::format("no triangles are left: the mesh meets {} cells only (--cell)", r.cells));
  return warnings;
}

ClusterOptions optionsOf(const ClusterRequest& request) {
  if (!request.cell) throw CLI::ValidationError("--cell", "is required");
  ClusterOptions options = request.options;
  options.cell = *request.cell;
  options.sigmaNormal = request.sigmaNormal.value_or(options.sigmaNormal);
  options.sigmaPosition = request.sigmaPosition.value_or(options.sigmaPosition);
  return options;
}

void checkFiles(const ClusterRequest& request) {
  checkMeshPath(request.output);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
}

Mesh clusterWithBar(const ClusterRequest& request, ClusterRun& run) {
  const auto warn = [&](const std::string& warning) {
    run.warnings.push_back(warning);
    if (!request.quiet) printWarning(warning);
  };
  // Nothing has been written yet, and files that are read whole cannot be stopped.
  const ExitOnInterrupt scope;
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  Mesh mesh = detail::withThreads(request.threads.value_or(0), [&] {
    return clusterFile(request.input, run.options, &run.report, warn, {.progress = show, .stop = &interruptFlag()});
  });
  return mesh;
}

}  // namespace

void addClusterOptions(CLI::App& command, ClusterRequest& request) {
  ClusterOptions& options = request.options;
  command.add_option("MESH", request.input, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_option("OUT", request.output, kWrittenMeshes)->required()->type_name("");
  const auto clustering = "Clustering";
  const auto notNegative = [](double v) { return v >= 0 && std::isfinite(v); };
  addReal(
      command, "--cell", request.cell, [](double v) { return std::isnormal(v) && v > 0 && std::isnormal(1 / v); },
      "a number > 0", "Edge of the cells, each of which becomes one vertex, in\nworld units (required)")
      ->type_name("H")
      ->group(clustering);
  addChoice(command, "--quadric", options.quadric, kQuadricWords,
            "What errors are measured by (probabilistic-plane):\nclassical, or with noise")
      ->type_name("KIND")
      ->group(clustering);
  addReal(command, "--sigma-n", request.sigmaNormal, notNegative, "a finite number >= 0",
          fmt::format("Noise of the unit normals ({})", options.sigmaNormal))
      ->type_name("S")
      ->group(clustering);
  addReal(command, "--sigma-p", request.sigmaPosition, notNegative, "a finite number >= 0",
          fmt::format("Noise of the vertices, in cells ({})", options.sigmaPosition))
      ->type_name("S")
      ->group(clustering);
  addReal(command, "--weld", options.weld, notNegative, "a finite number >= 0",
          "Vertices within D of each other become one before all\nelse, in world units; the file is then read whole")
      ->type_name("D")
      ->group(clustering);
  command.add_flag("--free", options.free, "Vertices may leave their cells")->group(clustering);
  command.add_flag("--clean", options.clean, "Drop folded and duplicate triangles")->group(clustering);
  const auto output = "Output";
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc cluster scan.ply small.ply --cell 0.5");
}

void runCluster(const ClusterRequest& request) {
  ClusterRun run;
  run.options = optionsOf(request);
  checkFiles(request);
  detail::Stopwatch stopwatch;
  const Mesh mesh = clusterWithBar(request, run);
  run.secondsCluster = stopwatch.lap();
  noteWarnings(warningsOf(run.report), request.quiet, run.warnings);
  run.bytesWritten = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
