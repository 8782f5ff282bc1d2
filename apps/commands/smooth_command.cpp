#include "commands/smooth_command.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "parallel/stopwatch.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/triangulate_polygons.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/make_with_bar.h"
#include "terminal/numbers.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

/// What one run did, as far as the library does not say it. Seconds are wall-clock time.
struct SmoothRun {
  SmoothOptions options;
  SmoothReport report;
  std::size_t bytesWritten = 0;
  double secondsRead = 0, secondsSmooth = 0, secondsWrite = 0;
  std::vector<std::string> warnings;
};

Json toJson(const SmoothRequest& request, const SmoothRun& run) {
  const SmoothReport& r = run.report;
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"iterations", run.options.iterations},
          {"sigma", run.options.sigma ? Json(*run.options.sigma) : Json("adaptive")},
          {"sigma_property", run.options.sigmaProperty},
          {"normalise_area", run.options.normaliseArea},
          {"plain", run.options.plain},
          {"lock_boundary", run.options.lockBoundary},
          {"vertices", r.vertices},
          {"triangles", r.triangles},
          {"boundary_vertices", r.boundaryVertices},
          {"degenerate_faces", r.degenerateFaces},
          {"mean_edge", r.meanEdge},
          {"mean_sigma", r.meanSigma},
          {"largest_sigma", r.largestSigma},
          {"mean_move", r.meanMove},
          {"largest_move", r.largestMove},
          {"limited_moves", r.limitedMoves},
          {"bytes", run.bytesWritten},
          {"seconds", {{"read", run.secondsRead}, {"smooth", run.secondsSmooth}, {"write", run.secondsWrite}}},
          {"warnings", run.warnings}};
}

void printSummary(const SmoothRequest& request, const SmoothRun& run) {
  const SmoothReport& r = run.report;
  fmt::print("{}: {} vertices, {} triangles; {} bytes\n", shownPath(request.output), r.vertices, r.triangles,
             run.bytesWritten);
  fmt::print("sigma {:.2g} mean edges, at most {:.2g}; vertices moved by {:.2g}, at most {:.2g}\n", r.meanSigma,
             r.largestSigma, r.meanMove, r.largestMove);
  fmt::print("{:.2f} s: reading {:.2f}, smoothing {:.2f}, writing {:.2f}\n",
             run.secondsRead + run.secondsSmooth + run.secondsWrite, run.secondsRead, run.secondsSmooth,
             run.secondsWrite);
}

/// What the user should know of, one line each.
std::vector<std::string> warningsOf(const SmoothReport& r) {
  std::vector<std::string> warnings;
  if (r.degenerateFaces > 0)
    warnings.push_back(
        fmt::format("{} triangles name a vertex twice or are not finite and have no say", r.degenerateFaces));
  return warnings;
}

/// A number, or `adaptive`.
std::function<void(const std::string&)> takeSigma(std::optional<double>& target) {
  return [&target](const std::string& text) {
    const std::vector<double> value = parseReals(text, ',');
    const bool number = value.size() == 1 && value[0] >= 0 && std::isfinite(value[0]);
    if (text != "adaptive" && !number)
      throw CLI::ValidationError("--sigma", fmt::format("'{}' is not a finite number >= 0, or adaptive", text));
    target = number ? std::optional(value[0]) : std::nullopt;
  };
}

void checkFiles(const SmoothRequest& request) {
  checkMeshPath(request.output);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
}

Mesh readTriangles(const SmoothRequest& request, SmoothRun& run) {
  const ExitOnInterrupt scope;
  const BusySign sign(!request.quiet, "reading " + request.input.filename().string());
  MeshFile file = readMeshFile(request.input, request.quiet);
  run.warnings = std::move(file.warnings);
  triangulatePolygons(file.mesh);
  return std::move(file.mesh);
}

}  // namespace

void addSmoothOptions(CLI::App& command, SmoothRequest& request) {
  SmoothOptions& options = request.options;
  command.add_option("MESH", request.input, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_option("OUT", request.output, kWrittenMeshes)->required()->type_name("");
  const auto smoothing = "Smoothing";
  addInteger(command, "--iterations", request.iterations, 0, 1000,
             fmt::format("How often quadrics are averaged with their neighbours ({})", options.iterations))
      ->type_name("K")
      ->group(smoothing);
  command
      .add_option_function<std::string>(
          "--sigma", takeSigma(options.sigma),
          "Noise of the vertices, in mean edge lengths (adaptive: what\nthe surface seems "
          "to have around each)")
      ->type_name("S|adaptive")
      ->group(smoothing);
  command
      .add_option("--sigma-property", options.sigmaProperty,
                  "Property with the noise of each vertex, in world units,\nas\npdc mesh --confidence writes sigma")
      ->type_name("NAME")
      ->group(smoothing);
  command.add_flag("--normalise-area", options.normaliseArea, "Faces count alike, whatever their size")
      ->group(smoothing);
  command.add_flag("--plain", options.plain, "Average across creases, too, as the paper does")->group(smoothing);
  command.add_flag("--lock-boundary", options.lockBoundary, "Vertices at boundaries stay")->group(smoothing);
  const auto output = "Output";
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc smooth scan.ply smooth.ply");
}

void runSmooth(const SmoothRequest& request) {
  checkFiles(request);
  SmoothRun run;
  run.options = request.options;
  run.options.iterations = request.iterations.value_or(run.options.iterations);
  detail::Stopwatch stopwatch;
  Mesh mesh = readTriangles(request, run);
  run.secondsRead = stopwatch.lap();
  mesh = makeWithBar(request, [&](const Monitor& monitor) { return smooth(mesh, run.options, &run.report, monitor); });
  run.secondsSmooth = stopwatch.lap();
  noteWarnings(warningsOf(run.report), request.quiet, run.warnings);
  run.bytesWritten = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
