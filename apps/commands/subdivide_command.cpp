#include "commands/subdivide_command.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "io/mesh/mesh_format.h"
#include "parallel/stopwatch.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "terminal/busy_sign.h"
#include "terminal/choice_option.h"
#include "terminal/interrupt.h"
#include "terminal/make_with_bar.h"
#include "terminal/numbers.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

const Choices<SubdivisionScheme> kSchemes{{"loop", SubdivisionScheme::kLoop},
                                          {"catmull-clark", SubdivisionScheme::kCatmullClark}};
const Choices<LoopWeights> kWeights{{"loop", LoopWeights::kLoop}, {"warren", LoopWeights::kWarren}};
const Choices<CovarianceChoice> kCovariances{{"faces", CovarianceChoice::kFaces},
                                             {"vertices", CovarianceChoice::kVertices},
                                             {"normals", CovarianceChoice::kNormals},
                                             {"file", CovarianceChoice::kFile},
                                             {"none", CovarianceChoice::kNone}};

/// What one run did, as far as the library does not say it. Seconds are wall-clock time.
struct SubdivideRun {
  SubdivideReport report;
  std::size_t bytesWritten = 0;
  double secondsRead = 0, secondsSubdivide = 0, secondsWrite = 0;
  std::vector<std::string> warnings;
};

/// What the covariances are made from; nothing for the linear schemes.
std::optional<InferenceOptions> inferenceOf(const SubdivideRequest& request) {
  InferenceOptions options;
  options.bias = request.bias.value_or(options.bias);
  options.absoluteBias = request.absoluteBias;
  options.sigmaNormal = request.sigmaNormal.value_or(options.sigmaNormal);
  switch (request.covariance) {
    case CovarianceChoice::kNone:
      return std::nullopt;
    case CovarianceChoice::kVertices:
      options.source = CovarianceSource::kVertices;
      break;
    case CovarianceChoice::kNormals:
      options.source = CovarianceSource::kNormals;
      break;
    case CovarianceChoice::kFile:
      options.source = CovarianceSource::kProperties;
      break;
    case CovarianceChoice::kFaces:
      break;
  }
  return options;
}

bool hasLimit(const SubdivideRequest& request) {
  return request.options.limit || request.options.normals || request.options.curvature;
}

Json toJson(const SubdivideRequest& request, const SubdivideRun& run) {
  const SubdivideReport& r = run.report;
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"scheme", wordOf(kSchemes, request.options.scheme)},
          {"weights", wordOf(kWeights, request.options.weights)},
          {"covariance", wordOf(kCovariances, request.covariance)},
          {"levels", request.levels.value_or(request.options.levels)},
          {"limit", hasLimit(request)},
          {"faces_before", r.facesBefore},
          {"faces", r.facesAfter},
          {"vertices_before", r.verticesBefore},
          {"vertices", r.verticesAfter},
          {"triangulated_faces", r.triangulatedFaces},
          {"unused_vertices", r.unusedVertices},
          {"boundary_edges", r.boundaryEdges},
          {"crease_edges", r.creaseEdges},
          {"extraordinary_vertices", r.extraordinaryVertices},
          {"estimated_curvatures", r.estimatedCurvatures},
          {"bytes", run.bytesWritten},
          {"seconds", {{"read", run.secondsRead}, {"subdivide", run.secondsSubdivide}, {"write", run.secondsWrite}}},
          {"warnings", run.warnings}};
}

void printSummary(const SubdivideRequest& request, const SubdivideRun& run) {
  const SubdivideReport& r = run.report;
  fmt::print("{}: {} faces of {}, {} vertices; {} bytes\n", shownPath(request.output), r.facesAfter, r.facesBefore,
             r.verticesAfter, run.bytesWritten);
  fmt::print("{} boundary edges, {} creases, {} extraordinary vertices\n", r.boundaryEdges, r.creaseEdges,
             r.extraordinaryVertices);
  if (request.options.curvature)
    fmt::print("the curvature of {} vertices is the mean of their neighbours'\n", r.estimatedCurvatures);
  fmt::print("{:.2f} s: reading {:.2f}, subdividing {:.2f}, writing {:.2f}\n",
             run.secondsRead + run.secondsSubdivide + run.secondsWrite, run.secondsRead, run.secondsSubdivide,
             run.secondsWrite);
}

/// What the user should know of, one line each.
std::vector<std::string> warningsOf(const SubdivideRequest& request, const SubdivideRun& run) {
  std::vector<std::string> warnings;
  if (run.report.triangulatedFaces > 0)
    warnings.push_back(
        fmt::format("{} faces with more than three corners became triangles: --scheme catmull-clark "
                    "takes them as they are",
                    run.report.triangulatedFaces));
  const bool properties = request.options.curvature || request.options.keepCovariances;
  if (properties && !detail::outputFormat(request.output).holdsProperties())
    warnings.push_back(fmt::format("only {} files hold curvature and covariances, which are left out",
                                   detail::kFormatsWithProperties));
  return warnings;
}

void checkRequest(const SubdivideRequest& request) {
  const auto refuse = [](const char* option, const char* why) { throw CLI::ValidationError(option, why); };
  const bool biased =
      request.covariance == CovarianceChoice::kFaces || request.covariance == CovarianceChoice::kVertices;
  if (!biased && (request.bias || request.absoluteBias))
    refuse(request.bias ? "--bias" : "--absolute-bias", "needs --covariance faces or vertices");
  if (request.covariance != CovarianceChoice::kNormals && request.sigmaNormal)
    refuse("--sigma-n", "needs --covariance normals");
  if (request.covariance == CovarianceChoice::kNone && request.options.keepCovariances)
    refuse("--keep-covariances", "excludes --covariance none");
  checkMeshPath(request.output);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
}

bool isPositive(double v) { return v > 0 && std::isfinite(v); }

void addCovarianceOptions(CLI::App& command, SubdivideRequest& request) {
  const auto group = "Covariances";
  addChoice(command, "--covariance", request.covariance, kCovariances,
            "What makes the Gaussians of the vertices (faces): their\nfaces, neighbours or normals, or the file; none: "
            "the linear\nscheme")
      ->type_name("FROM")
      ->group(group);
  CLI::Option* bias =
      addReal(command, "--bias", request.bias, isPositive, "a finite number above 0",
              "Added to the covariances of faces or neighbours, as a share\nof the largest eigenvalue (0.05)");
  bias->type_name("B")->group(group);
  addReal(command, "--absolute-bias", request.absoluteBias, isPositive, "a finite number above 0",
          "The same in world units squared")
      ->type_name("B")
      ->group(group)
      ->excludes(bias);
  addReal(command, "--sigma-n", request.sigmaNormal, isPositive, "a finite number above 0",
          "Noise of the unit normals, for --covariance normals (0.1)")
      ->type_name("S")
      ->group(group);
  command.add_flag("--keep-covariances", request.options.keepCovariances, "Write covariances, into a .ply")
      ->group(group);
}

}  // namespace

void addSubdivideOptions(CLI::App& command, SubdivideRequest& request) {
  SubdivideOptions& options = request.options;
  command.add_option("MESH", request.input, ".ply, .obj, .off or .stl")->required()->type_name("");
  command.add_option("OUT", request.output, kWrittenMeshes)->required()->type_name("");
  const auto scheme = "Scheme";
  addInteger(command, "--levels", request.levels, 1, 31, "How many times faces are split (2)")
      ->type_name("N")
      ->group(scheme);
  addChoice(command, "--scheme", options.scheme, kSchemes,
            "loop: triangles into four; catmull-clark: any faces into\nquads (loop)")
      ->type_name("NAME")
      ->group(scheme);
  addChoice(command, "--weights", options.weights, kWeights, "Whose weights in Loop's scheme (loop)")
      ->type_name("WHOSE")
      ->group(scheme);
  addReal(
      command, "--crease-angle", options.creaseAngle, [](double v) { return v > 0 && v <= 180; },
      "degrees above 0 and at most 180", "Edges whose faces turn by more stay sharp, in degrees (none)")
      ->type_name("DEG")
      ->group(scheme);
  command.add_flag("--limit", options.limit, "Vertices go to the limit surface")->group(scheme);
  command.add_flag("--normals", options.normals, "Normals of the limit surface; implies --limit")->group(scheme);
  command
      .add_flag("--curvature", options.curvature,
                "Properties mean_curvature and gaussian_curvature of the limit\nsurface in a .ply; implies --limit")
      ->group(scheme);
  addCovarianceOptions(command, request);
  const auto output = "Output";
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc subdivide coarse.obj smooth.ply --levels 3 --covariance faces --bias 0.05");
}

void runSubdivide(const SubdivideRequest& request) {
  checkRequest(request);
  SubdivideRun run;
  detail::Stopwatch stopwatch;
  Mesh mesh;
  {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.input.filename().string());
    const bool polygons = request.options.scheme == SubdivisionScheme::kCatmullClark;
    MeshFile file = readMeshFile(request.input, request.quiet, polygons);
    run.warnings = std::move(file.warnings);
    mesh = std::move(file.mesh);
  }
  run.secondsRead = stopwatch.lap();
  SubdivideOptions options = request.options;
  options.levels = request.levels.value_or(options.levels);
  options.covariances = inferenceOf(request);
  options.limit = hasLimit(request);
  mesh = makeWithBar(request, [&](const Monitor& monitor) { return subdivide(mesh, options, &run.report, monitor); });
  run.secondsSubdivide = stopwatch.lap();
  noteWarnings(warningsOf(request, run), request.quiet, run.warnings);
  run.bytesWritten = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
