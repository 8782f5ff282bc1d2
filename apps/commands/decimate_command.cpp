#include "commands/decimate_command.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "parallel/stopwatch.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/mesh/triangulate_polygons.h"
#include "pdc/mesh/weld_vertices.h"
#include "requests/quadric_words.h"
#include "terminal/busy_sign.h"
#include "terminal/choice_option.h"
#include "terminal/interrupt.h"
#include "terminal/length_option.h"
#include "terminal/make_with_bar.h"
#include "terminal/numbers.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

const Choices<CollapsePlacement> kPlacements{{"minimizer", CollapsePlacement::kMinimizer},
                                             {"subset", CollapsePlacement::kSubset}};

const Choices<DecimateEnd> kEnds{{"reached", DecimateEnd::kReached},
                                 {"error", DecimateEnd::kError},
                                 {"no_collapse_left", DecimateEnd::kNoCollapseLeft}};

/// What one run did, as far as the library does not say it. Seconds are wall-clock time.
struct DecimateRun {
  DecimateReport report;
  bool soup = false;  ///< No faces given share a vertex.
  std::size_t bytesWritten = 0;
  double secondsRead = 0, secondsDecimate = 0, secondsWrite = 0;
  std::vector<std::string> warnings;
};

/// A number, or `auto` for the mesh's own.
void addFromMesh(CLI::App& command, const std::string& name, std::optional<double>& target, double most,
                 const std::string& help) {
  const auto take = [name, &target, most](const std::string& text) {
    const std::vector<double> value = parseReals(text, ',');
    const bool number = value.size() == 1 && value[0] >= 0 && value[0] <= most && std::isfinite(value[0]);
    if (text != "auto" && !number)
      throw CLI::ValidationError(
          name, fmt::format("'{}' is not {}, or auto", text, most == 1 ? "a number from 0 to 1" : "a number >= 0"));
    target = number ? std::optional(value[0]) : std::nullopt;
  };
  command.add_option_function<std::string>(name, take, help)->type_name("S|auto")->group("Quadrics");
}

void addNoiseOptions(CLI::App& command, DecimateOptions& options) {
  addFromMesh(command, "--sigma-n", options.sigmaNormal, std::numeric_limits<double>::max(),
              "Noise of the unit normals (auto: from the mesh's own)");
  addFromMesh(command, "--sigma-p", options.sigmaPosition, std::numeric_limits<double>::max(),
              "Noise of the vertices, in mean edge lengths (auto)");
  command
      .add_option(
          "--sigma-property", options.sigmaProperty,
          "Property with the noise of each vertex, in world units,\nthat takes the place of the mesh's own; cov: "
          "covariances")
      ->type_name("NAME")
      ->group("Quadrics");
  addFromMesh(command, "--memory", options.memory, 1,
              "Share of the faces given in the quadrics, the rest being that\nof the faces left (auto: 0 where there "
              "is no noise)");
}

/// Null where pairs without an edge were none.
Json toJson(const std::optional<PairReport>& pairs) {
  if (!pairs) return nullptr;
  return {{"merges", pairs->merges},
          {"duplicate_faces", pairs->duplicateFaces},
          {"components_before", pairs->componentsBefore},
          {"components", pairs->componentsAfter},
          {"non_manifold_edges", pairs->nonManifoldEdges},
          {"non_manifold_vertices", pairs->nonManifoldVertices}};
}

Json toJson(const DecimateRequest& request, const DecimateRun& run) {
  const DecimateReport& r = run.report;
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"quadric", wordOf(kQuadricWords, request.options.quadric)},
          {"placement", wordOf(kPlacements, request.options.placement)},
          {"faces_before", r.facesBefore},
          {"faces", r.facesAfter},
          {"vertices_before", r.verticesBefore},
          {"vertices", r.verticesAfter},
          {"welded_vertices", r.weldedVertices},
          {"end", wordOf(kEnds, r.end)},
          {"error", request.options.error ? Json(r.error) : Json(nullptr)},
          {"mean_edge", r.meanEdge},
          {"sigma_property", request.options.sigmaProperty},
          {"noise", r.noise},
          {"sigma_n", r.sigmaNormal},
          {"sigma_p", r.sigmaPosition},
          {"memory", r.memory},
          {"rounds", r.rounds},
          {"collapses", r.collapses},
          {"limited_moves", r.limitedMoves},
          {"refused_intersections", r.refusedIntersections},
          {"refused_errors", r.refusedErrors},
          {"degenerate_faces", r.degenerateFaces},
          {"non_manifold_vertices", r.nonManifoldVertices},
          {"pairs", toJson(r.pairs)},
          {"bytes", run.bytesWritten},
          {"seconds", {{"read", run.secondsRead}, {"decimate", run.secondsDecimate}, {"write", run.secondsWrite}}},
          {"warnings", run.warnings}};
}

void printSummary(const DecimateRequest& request, const DecimateRun& run) {
  const DecimateReport& r = run.report;
  fmt::print("{}: {} of {} triangles, {} vertices; {} bytes\n", shownPath(request.output), r.facesAfter, r.facesBefore,
             r.verticesAfter, run.bytesWritten);
  fmt::print("noise {:.2g} mean edges; sigma_n {:.2g}, memory {:.2g}\n", r.noise, r.sigmaNormal, r.memory);
  if (request.options.error) fmt::print("no point of either surface is farther than {:.4g} from the other\n", r.error);
  if (r.pairs)
    fmt::print("{} merges without an edge; {} components of {}; {} non-manifold edges, {} non-manifold vertices\n",
               r.pairs->merges, r.pairs->componentsAfter, r.pairs->componentsBefore, r.pairs->nonManifoldEdges,
               r.pairs->nonManifoldVertices);
  fmt::print("{:.2f} s: reading {:.2f}, decimating {:.2f}, writing {:.2f}\n",
             run.secondsRead + run.secondsDecimate + run.secondsWrite, run.secondsRead, run.secondsDecimate,
             run.secondsWrite);
}

/// What the user should know of, one line each.
std::vector<std::string> warningsOf(const DecimateRequest& request, const DecimateRun& run) {
  const DecimateReport& r = run.report;
  std::vector<std::string> warnings;
  if (run.soup && !request.options.weld)
    warnings.push_back(
        "no two faces share a vertex, so that each is a boundary all around: --weld 0 joins them where "
        "their corners are equal, --weld D where they lie within D");
  if (r.end == DecimateEnd::kNoCollapseLeft)
    warnings.push_back(
        fmt::format("{} triangles are left: each further collapse would change the topology, turn a face "
                    "too far (--max-turn) or move a locked vertex",
                    r.facesAfter));
  if (r.nonManifoldVertices > 0 && !r.pairs)
    warnings.push_back(
        fmt::format("the surface is no manifold at {} vertices, which stay as they are", r.nonManifoldVertices));
  if (r.degenerateFaces > 0)
    warnings.push_back(
        fmt::format("{} triangles name a vertex twice or are not finite and are left out", r.degenerateFaces));
  return warnings;
}

void checkRequest(const DecimateRequest& request) {
  if (!request.faces && !request.options.ratio && !request.options.error)
    throw CLI::ValidationError("--faces", "or --ratio or --error is required");
  // With pairs nothing looks for intersections, and quadrics are those of the faces given.
  if (request.options.pairDistance && request.options.sound)
    throw CLI::ValidationError("--pair-distance", "excludes --sound");
  if (request.options.pairDistance && request.options.error)
    throw CLI::ValidationError("--pair-distance", "excludes --error");
  if (request.options.pairDistance && request.options.memory.value_or(1) != 1)
    throw CLI::ValidationError("--pair-distance", "needs --memory 1, or auto");
  checkMeshPath(request.output);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
}

void addTargetOptions(CLI::App& command, DecimateRequest& request) {
  DecimateOptions& options = request.options;
  const auto target = "Target, the first that is met";
  addInteger(command, "--faces", request.faces, 0, std::numeric_limits<int>::max(), "Triangles at most")
      ->type_name("N")
      ->group(target);
  addReal(
      command, "--ratio", options.ratio, [](double v) { return v > 0 && v <= 1; }, "a number above 0 and at most 1",
      "Triangles at most, as a share of those given")
      ->type_name("R")
      ->group(target);
  addLength(
      command, "--error", options.error,
      "No point of either surface goes farther than this from\nthe other; 0.1L: in mean edge lengths. Takes longer")
      ->type_name("E|EL")
      ->group(target);
}

}  // namespace

void addDecimateOptions(CLI::App& command, DecimateRequest& request) {
  DecimateOptions& options = request.options;
  command.add_option("MESH", request.input, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_option("OUT", request.output, kWrittenMeshes)->required()->type_name("");
  addTargetOptions(command, request);
  addReal(
      command, "--weld", options.weld, [](double v) { return v >= 0 && std::isfinite(v); }, "a finite number >= 0",
      "Vertices within D of each other become one before all\nelse, in world units; 0: those at one place")
      ->type_name("D")
      ->group("Input");
  const auto quadrics = "Quadrics";
  addChoice(command, "--quadric", options.quadric, kQuadricWords,
            "What errors are measured by (probabilistic-plane):\nclassical, or with noise")
      ->type_name("KIND")
      ->group(quadrics);
  addNoiseOptions(command, options);
  addChoice(command, "--placement", options.placement, kPlacements,
            "Where vertices go (minimizer): to the least error, or to\none of the edge's ends")
      ->type_name("WHERE")
      ->group(quadrics);
  addReal(
      command, "--max-turn", request.maxTurn, [](double v) { return v > 0 && v <= 90; },
      "degrees above 0 and at most 90", "No face turns farther in one step, in degrees (75)")
      ->type_name("DEG")
      ->group(quadrics);
  addReal(
      command, "--boundary-weight", request.boundaryWeight, [](double v) { return v >= 0 && std::isfinite(v); },
      "a finite number >= 0", "How much boundaries resist, relative to faces (10)")
      ->type_name("W")
      ->group(quadrics);
  command.add_flag("--sound", options.sound, "No faces come to intersect; takes several times as long")
      ->group(quadrics);
  command.add_flag("--no-fit", request.noFit, "Leave out the least squares at the end")->group(quadrics);
  command.add_flag("--lock-boundary", options.lockBoundary, "Vertices at boundaries stay")->group(quadrics);
  addLength(command, "--pair-distance", options.pairDistance,
            "Merge vertices closer than T without an edge, too, in world\nunits, or mean edge lengths with L as in 2L "
            "(none)")
      ->type_name("T|TL")
      ->group(quadrics);
  const auto output = "Output";
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc decimate scan.ply small.ply --ratio 0.05");
}

void runDecimate(const DecimateRequest& request) {
  checkRequest(request);
  DecimateRun run;
  detail::Stopwatch stopwatch;
  Mesh mesh;
  {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.input.filename().string());
    MeshFile file = readMeshFile(request.input, request.quiet);
    run.warnings = std::move(file.warnings);
    mesh = std::move(file.mesh);
    run.soup = isSoup(mesh);
    triangulatePolygons(mesh);
  }
  run.secondsRead = stopwatch.lap();

  DecimateOptions options = request.options;
  if (request.faces) options.faces = static_cast<std::size_t>(*request.faces);
  options.maxTurn = request.maxTurn.value_or(options.maxTurn);
  options.fit = !request.noFit;
  options.boundaryWeight = request.boundaryWeight.value_or(options.boundaryWeight);
  mesh = makeWithBar(request, [&](const Monitor& monitor) { return decimate(mesh, options, &run.report, monitor); });
  run.secondsDecimate = stopwatch.lap();
  noteWarnings(warningsOf(request, run), request.quiet, run.warnings);
  run.bytesWritten = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
