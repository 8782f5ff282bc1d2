#include "commands/points/mixture_command.h"

#include <fmt/format.h>

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

void addMixtureCommandOptions(CLI::App& command, MixtureCommandRequest& request) {
  command.add_option("POINTS", request.input, ".ply, .xyz, .pts, .txt, .pcd or .vdb")->required()->type_name("");
  command.add_option("OUT", request.output, ".ply")->required()->type_name("");
  addMixtureOptions(command, request.mixture);
  const auto output = "Output";
  command.add_flag("--ascii", request.ascii, "The .ply as text")->group(output);
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc mixture scan.ply gaussians.ply --alpha 2.2");
}

void runMixture(const MixtureCommandRequest& request) {
  checkPointsPath(request.input);
  if (request.output.extension() != ".ply") throw CLI::ValidationError("OUT", "only .ply files hold Gaussians");
  checkMeshPath(request.output);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
  std::vector<std::string> warnings;
  detail::Stopwatch stopwatch;
  const PointCloud cloud = readPointsFile(request.input, request.quiet, warnings);
  const double secondsRead = stopwatch.lap();
  MixtureReport report;
  std::size_t gaussians = 0;
  const Mesh mesh = makeWithBar(request, [&](const Monitor& monitor) {
    const GaussianMixture mixture = gaussianMixture(cloud, mixtureOptions(request.mixture), &report, monitor);
    gaussians = mixture.size();
    return mixtureMesh(mixture);
  });
  const double secondsMixture = stopwatch.lap();
  const std::size_t bytes = writeMeshFile(mesh, request.output, {.ascii = request.ascii}, request.quiet);
  const double secondsWrite = stopwatch.lap();
  nlohmann::ordered_json json{{"input", shownPath(request.input)}, {"output", shownPath(request.output)}};
  json.update(toJson(report));
  json.update({{"gaussians", gaussians},
               {"bytes", bytes},
               {"seconds", {{"read", secondsRead}, {"mixture", secondsMixture}, {"write", secondsWrite}}},
               {"warnings", warnings}});
  writeJson(json, request.json);
  if (request.quiet || request.json == "-") return;
  fmt::print("{}: {} Gaussians of {} points, sigma0 {:.4g}; {} bytes\n", shownPath(request.output), gaussians,
             report.points, report.sigma0, bytes);
  fmt::print("{:.2f} s: reading {:.2f}, mixture {:.2f}, writing {:.2f}\n", secondsRead + secondsMixture + secondsWrite,
             secondsRead, secondsMixture, secondsWrite);
}

}  // namespace pdc
