#include "commands/points/reconstruct_command.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "files/json_file.h"
#include "files/mesh_file.h"
#include "parallel/stopwatch.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/io/points/points_reader.h"
#include "reports/points_report.h"
#include "terminal/make_with_bar.h"
#include "terminal/numbers.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

/// What one run did, as far as the library does not say it. Seconds are wall-clock time.
struct ReconstructRun {
  ReconstructReport report;
  std::size_t vertices = 0, triangles = 0, bytesWritten = 0, covarianceBytes = 0;
  double secondsRead = 0, secondsWrite = 0;
  std::vector<std::string> warnings;
};

Json toJson(const ReconstructRequest& request, const ReconstructRun& run) {
  const ReconstructReport& r = run.report;
  Json json{{"input", shownPath(request.input)}, {"output", shownPath(request.output)}};
  json.update(toJson(r));
  json.update({{"vertices", run.vertices},
               {"triangles", run.triangles},
               {"bytes", run.bytesWritten},
               {"covariance_mesh_bytes", run.covarianceBytes},
               {"seconds",
                {{"read", run.secondsRead},
                 {"mixture", r.secondsMixture},
                 {"triangulate", r.secondsTriangulate},
                 {"subdivide", r.secondsSubdivide},
                 {"contour", r.secondsContour},
                 {"write", run.secondsWrite}}},
               {"warnings", run.warnings}});
  return json;
}

void printSummary(const ReconstructRequest& request, const ReconstructRun& run) {
  const ReconstructReport& r = run.report;
  fmt::print("{}: {} triangles, {} vertices of {} points and {} Gaussians; {} bytes\n", shownPath(request.output),
             run.triangles, run.vertices, r.mixture.points, r.gaussians, run.bytesWritten);
  fmt::print("{} components, {} boundaries, {} Gaussians unused\n", r.triangulation.components,
             r.triangulation.boundaryLoops, r.triangulation.unusedGaussians);
  fmt::print(
      "{:.2f} s: reading {:.2f}, mixture {:.2f}, triangles {:.2f}, subdividing {:.2f}, contouring {:.2f}, "
      "writing {:.2f}\n",
      run.secondsRead + r.secondsMixture + r.secondsTriangulate + r.secondsSubdivide + r.secondsContour +
          run.secondsWrite,
      run.secondsRead, r.secondsMixture, r.secondsTriangulate, r.secondsSubdivide, r.secondsContour, run.secondsWrite);
}

void checkRequest(const ReconstructRequest& request) {
  checkPointsPath(request.input);
  checkMeshPath(request.output);
  if (!request.covariances.empty()) {
    if (request.covariances.extension() != ".ply")
      throw CLI::ValidationError("--mesh-covariances", "only .ply files hold covariances");
    checkMeshPath(request.covariances);
  }
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
}

}  // namespace

void addReconstructOptions(CLI::App& command, ReconstructRequest& request) {
  command.add_option("POINTS", request.input, ".ply, .xyz, .pts, .txt, .pcd or .vdb")->required()->type_name("");
  command.add_option("OUT", request.output, kWrittenMeshes)->required()->type_name("");
  addMixtureOptions(command, request.mixture);
  const auto surface = "Surface";
  addReal(
      command, "--overlap", request.leastOverlap, [](double v) { return v > 0 && v < 1; }, "a number between 0 and 1",
      "Least Bhattacharyya coefficient of Gaussians that are\njoined (0.15)")
      ->type_name("B")
      ->group(surface);
  command.add_flag("--close", request.close, "Close all boundaries")->group(surface);
  addInteger(command, "--subdivide", request.subdivisions, 0, 10, "How many times triangles are split into four (1)")
      ->type_name("N")
      ->group(surface);
  addReal(
      command, "--voxel-size", request.voxelSize, [](double v) { return v > 0 && std::isfinite(v); },
      "a finite number above 0",
      "Close the surface and contour the ridge of the mixture near\nit with voxels of this size")
      ->type_name("H")
      ->group(surface);
  const auto output = "Output";
  command.add_option("--mesh-covariances", request.covariances, "Also write the covariance mesh, a .ply")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--ascii", request.ascii, ".ply and .stl as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc reconstruct scan.ply surface.ply --subdivide 2");
}

void runReconstruct(const ReconstructRequest& request) {
  checkRequest(request);
  ReconstructRun run;
  detail::Stopwatch stopwatch;
  const PointCloud cloud = readPointsFile(request.input, request.quiet, run.warnings);
  run.secondsRead = stopwatch.lap();
  ReconstructOptions options;
  options.mixture = mixtureOptions(request.mixture);
  options.triangulation.leastOverlap = request.leastOverlap.value_or(options.triangulation.leastOverlap);
  options.triangulation.close = request.close;
  options.voxelSize = request.voxelSize;
  options.subdivisions = request.subdivisions.value_or(options.subdivisions);
  Mesh covarianceMesh;
  const Mesh mesh = makeWithBar(request, [&](const Monitor& monitor) {
    return reconstruct(cloud, options, &run.report, request.covariances.empty() ? nullptr : &covarianceMesh, monitor);
  });
  stopwatch.lap();
  run.vertices = mesh.positions.size();
  run.triangles = mesh.triangles.size();
  if (!request.covariances.empty())
    run.covarianceBytes = writeMeshFile(covarianceMesh, request.covariances, {.ascii = request.ascii}, request.quiet);
  run.bytesWritten = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
