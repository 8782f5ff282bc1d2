#include "requests/sweep_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "requests/volume_request.h"
#include "terminal/numbers.h"
#include "terminal/view_option.h"

namespace pdc {
namespace {

void addReals(CLI::App& command, const std::string& name, std::vector<double>& target,
              const std::function<bool(double)>& accepts, const std::string& limit, const std::string& help) {
  const auto take = [name, limit, &target, accepts](const std::string& text) {
    target = parseReals(text, ',');
    std::vector<double> sorted = target;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw CLI::ValidationError(name, fmt::format("'{}' has a value twice", text));
    if (target.empty() || !std::all_of(target.begin(), target.end(), accepts))
      throw CLI::ValidationError(name, fmt::format("'{}' is not a list of {}, separated by commas", text, limit));
  };
  command.add_option_function<std::string>(name, take, help)->type_name("LIST");
}

/// Lengths like "0,0.05v": all in voxels, or all in world units, but that 0 is the same in both. \throws
/// CLI::ValidationError.
void readDistances(const std::string& text, SweepRequest& request) {
  const auto refuse = [&text](const char* limit) {
    throw CLI::ValidationError("--adaptive", fmt::format("'{}' {}", text, limit));
  };
  request.adaptive.clear();
  bool voxels = false, world = false;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const bool suffixed = end > begin && text[end - 1] == 'v';
    const std::vector<double> value = parseReals(text.substr(begin, end - begin - (suffixed ? 1 : 0)), ',');
    if (value.size() != 1 || !(value[0] >= 0) || !std::isfinite(value[0]))
      refuse("is not a list of finite numbers >= 0, separated by commas, with v for voxels");
    if (std::count(request.adaptive.begin(), request.adaptive.end(), value[0]) > 0) refuse("has a value twice");
    if (value[0] > 0) (suffixed ? voxels : world) = true;
    request.adaptive.push_back(value[0]);
    begin = end + 1;
  }
  if (voxels && world) refuse("mixes voxels and world units");
  request.adaptiveInVoxels = voxels;
}

void addDistances(CLI::App& command, SweepRequest& request) {
  command
      .add_option_function<std::string>(
          "--adaptive", [&request](const std::string& text) { readDistances(text, request); },
          "Fewer faces within distances of the full mesh, in world units\n"
          "or, like 0.05v, in voxels; 0 is the full mesh")
      ->type_name("LIST");
}

bool isPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-_./,=:+@%").find(c) != std::string_view::npos;
}

}  // namespace

SweepParameter SweepRequest::parameter() const {
  if (isos.size() > 1) return SweepParameter::kIso;
  if (adaptive.size() > 1) return SweepParameter::kAdaptive;
  return voxelSizes.size() > 1 ? SweepParameter::kVoxelSize : SweepParameter::kSigmaNormal;
}

const std::vector<double>& SweepRequest::values() const {
  switch (parameter()) {
    case SweepParameter::kIso:
      return isos;
    case SweepParameter::kVoxelSize:
      return voxelSizes;
    case SweepParameter::kAdaptive:
      return adaptive;
    default:
      return sigmas;
  }
}

void addSweepOptions(CLI::App& command, SweepRequest& request) {
  const auto finite = [](double v) { return std::isfinite(v); };
  MeshRequest& mesh = request.mesh;
  command.add_option("INPUT", mesh.input, ".vdb, a volume, or a scene: .yaml, .yml")->required()->type_name("");
  command.add_option("OUTDIR", request.folder, "Folder for the report; made if it is not there")
      ->required()
      ->type_name("");
  addReals(
      command, "--sigma-n", request.sigmas, [](double v) { return v >= 0; }, "numbers >= 0 or inf",
      "Assumed noise of the unit normals (0,0.05,0.1,0.25,inf)");
  addReals(command, "--iso", request.isos, finite, "finite numbers", "Isovalues");
  addReals(
      command, "--voxel-size", request.voxelSizes, [](double v) { return v > 0 && std::isfinite(v); },
      "finite numbers > 0", "Of a scene: edges of a cell, in world units");
  addDistances(command, request);
  addPlacement(command, mesh.placement, "Where vertices may lie (certified), as for pdc mesh");
  command.add_flag("--open", mesh.open, "Surface ends where the data ends");
  addNonFinite(command, mesh.acceptNonFinite);
  command.add_option("--grid", mesh.grid, "Grid to take, if the .vdb has several")->type_name("NAME");
  addGridMeaning(command, mesh, "OPTIONS");
  addNoiseGrids(command, mesh, "OPTIONS");
  addAdaptiveGrid(command, mesh, "OPTIONS");
  addVolumeOptions(command, mesh.volume, "For volumes");
  addGridSteps(command, mesh.steps, "For .vdb inputs and volumes, before all else, in this order");
  command
      .add_option("--reference", request.reference,
                  "What the surface should be, a mesh or a scene\n(a scene that is swept is its own)")
      ->type_name("FILE");
  command.add_flag("--meshes", request.meshes, "Also the meshes, as .ply");
  addView(command, request.towardsViewer);
  command.add_flag("--quiet", mesh.quiet, "No summary and no progress bar");
  addThreads(command, mesh.threads);
  command.footer(
      "One of --sigma-n, --iso, --voxel-size and --adaptive may have several values; that one is swept.\n"
      "Example: pdc sweep part.vdb report --sigma-n 0,0.02,0.05,0.1,inf --reference part.yaml");
}

void settleSweepRequest(SweepRequest& request) {
  const std::vector<std::pair<const char*, const std::vector<double>*>> lists{{"--sigma-n", &request.sigmas},
                                                                              {"--iso", &request.isos},
                                                                              {"--voxel-size", &request.voxelSizes},
                                                                              {"--adaptive", &request.adaptive}};
  const char* swept = nullptr;
  for (const auto& [name, values] : lists) {
    if (values->size() < 2) continue;
    if (swept != nullptr) throw CLI::ValidationError(name, fmt::format("and {} have several values", swept));
    swept = name;
  }
  const bool adapts = std::any_of(request.adaptive.begin(), request.adaptive.end(), [](double d) { return d > 0; });
  if (request.mesh.adaptiveGrid && !adapts) throw CLI::ValidationError("--adaptive-grid", "needs --adaptive");
  if (swept == nullptr && request.sigmas.empty())
    request.sigmas = {0, 0.05, 0.1, 0.25, std::numeric_limits<double>::infinity()};
  if (!request.isos.empty()) request.mesh.iso = request.isos.front();
  if (!request.voxelSizes.empty()) request.mesh.voxelSize = request.voxelSizes.front();
  if (!request.sigmas.empty()) request.mesh.sigmaNormal = request.sigmas.front();
  checkMeshRequest(request.mesh);
}

std::string commandLine(const std::vector<std::string>& arguments) {
  std::string line = "pdc";
  for (const std::string& argument : arguments) {
    line += ' ';
    if (!argument.empty() && std::all_of(argument.begin(), argument.end(), isPlain)) {
      line += argument;
      continue;
    }
    line += '\'';
    for (const char c : argument) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

}  // namespace pdc
