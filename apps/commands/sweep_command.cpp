#include "commands/sweep_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "files/mesh_file.h"
#include "pdc/io/mesh/mesh_writer.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/render/render.h"
#include "pdc/sample/crease_points.h"
#include "pdc/study/sweep.h"
#include "pdc/study/sweep_writer.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"

namespace pdc {
namespace {

constexpr int kPictureSide = 480;  // pixels

/// Calls read() under a sign that says so.
template <typename Read>
auto reading(const std::filesystem::path& path, bool quiet, const Read& read) {
  const ExitOnInterrupt scope;
  const BusySign sign(!quiet, "reading " + path.filename().string());
  return read();
}

SweepTruth truthOf(const Input& input) {
  if (input.field == nullptr) return {};
  return {.field = input.field,
          .reference = nullptr,
          .creases = creasePoints(input.field, *input.source, {.stop = &interruptFlag()})};
}

/// Reads what --reference names: a scene, whose creases are found on its own lattice, or a mesh.
SweepTruth readReference(const std::filesystem::path& path, bool quiet) {
  if (inputKind(path) == InputKind::kScene) return truthOf(reading(path, quiet, [&] { return openInput(path); }));
  auto mesh = std::make_shared<Mesh>(reading(path, quiet, [&] { return readMeshFile(path).mesh; }));
  if (mesh->empty()) throw Error(fmt::format("{}: the reference has no faces", path.string()));
  return {.field = nullptr, .reference = std::move(mesh), .creases = {}};
}

/// What is odd about the inputs of all steps, each line once.
class Warnings {
 public:
  void say(const Input& input) {
    for (const std::string& warning : input.warnings)
      if (mSaid.insert(warning).second) std::fputs(fmt::format("pdc: warning: {}\n", warning).c_str(), stderr);
  }

 private:
  std::set<std::string> mSaid;
};

struct OpenedStep {
  SweepInput input;
  std::function<double(const Vec3d&)> adaptiveScale;  ///< See Input.
};

OpenedStep openStep(const SweepRequest& request, const MeshRequest& mesh, const SweepTruth& reference,
                    Warnings& warnings) {
  Input input = reading(mesh.input, mesh.quiet, [&] { return openInput(mesh.input, mesh.inputOptions()); });
  warnings.say(input);
  SweepTruth truth = request.reference.empty() ? truthOf(input) : reference;
  return {{std::move(input.source), std::move(truth)}, std::move(input.adaptiveScale)};
}

Sweep contourAll(const SweepRequest& request, const Monitor& monitor) {
  const SweepTruth reference =
      request.reference.empty() ? SweepTruth{} : readReference(request.reference, request.mesh.quiet);
  const SweepParameter parameter = request.parameter();
  Warnings warnings;
  auto [first, scale] = openStep(request, request.mesh, reference, warnings);
  SweepOptions options{.contour = request.mesh.contourOptions(kPapersSigmaNormal), .truth = {}};
  options.contour.adaptiveScale = std::move(scale);
  options.contour.origin.reset();  // Wherever the surface lies, its measures should not be those of rounding.
  if (parameter == SweepParameter::kAdaptive) {
    std::vector<double> distances = request.adaptive;
    if (!request.adaptiveInVoxels)
      for (double& d : distances) d /= first.source->map().voxelSize();
    options.truth = std::move(first.truth);
    return sweepAdaptive(*first.source, distances, options, monitor);
  }
  if (!request.adaptive.empty() && request.adaptive.front() > 0)
    (request.adaptiveInVoxels ? options.adaptive : options.contour.adaptive) = request.adaptive.front();
  if (parameter == SweepParameter::kSigmaNormal) {
    options.truth = std::move(first.truth);
    return sweepSigma(*first.source, request.values(), options, monitor);
  }
  return sweepInputs(
      parameter, request.values(),
      [&](double value) {
        MeshRequest mesh = request.mesh;
        (parameter == SweepParameter::kIso ? mesh.iso : mesh.voxelSize) = value;
        return openStep(request, mesh, reference, warnings).input;
      },
      options, monitor);
}

/// Draws all from one place, where the largest of the meshes fills the picture. A step without surface is blank.
std::vector<Image> drawAll(const SweepRequest& request, const std::vector<Mesh>& meshes, const Monitor& monitor) {
  RenderOptions options{.width = kPictureSide, .height = kPictureSide, .threads = request.mesh.threads.value_or(0)};
  options.camera = fitCamera(meshes, request.towardsViewer, kPictureSide, kPictureSide);
  std::vector<Image> pictures;
  for (const Mesh& mesh : meshes) {
    Image blank{kPictureSide, kPictureSide, {}};
    blank.pixels.resize(kPictureSide * kPictureSide, {255, 255, 255});
    const auto show = [&](const char* stage, double share) {
      monitor.progress(stage, (static_cast<double>(pictures.size()) + share) / static_cast<double>(meshes.size()));
    };
    pictures.push_back(mesh.empty() ? blank : render(mesh, options, {.progress = show, .stop = monitor.stop}));
  }
  return pictures;
}

void writeAll(const SweepRequest& request, const Sweep& sweep, const SweepDescription& description) {
  const ExitOnInterrupt scope;
  const BusySign sign(!request.mesh.quiet, "writing " + request.folder.string());
  for (std::size_t i = 0; request.meshes && i < sweep.meshes.size(); ++i)
    static_cast<void>(
        writeMesh(sweep.meshes[i],
                  request.folder / fmt::format("{}_{:.6g}.ply", namesOf(sweep.parameter).key, sweep.steps[i].value)));
  writeSweep(sweep, description, request.folder);
}

void printSummary(const SweepRequest& request, const Sweep& sweep) {
  const auto shown = [](const std::optional<double>& v) { return v ? fmt::format("{:.4f}", *v) : std::string("-"); };
  fmt::print("{:>10} {:>10} {:>12} {:>12} {:>10} {:>12} {:>10} {:>8}\n", namesOf(sweep.parameter).key, "triangles",
             "vertex RMS", "crease RMS", "roughness", "min angle 1%", "self-int.", "seconds");
  for (const SweepStep& step : sweep.steps)
    fmt::print("{:>10.6g} {:>10} {:>12} {:>12} {:>10.4f} {:>12.2f} {:>10} {:>8.3f}\n", step.value, step.triangles,
               shown(step.vertexRms), shown(step.creaseRms), step.roughness, step.minimumAngle[0],
               step.selfIntersections, step.seconds);
  fmt::print("Lengths in voxels, angles in degrees. {}\n{}\n", sweep.reason, (request.folder / "index.html").string());
}

}  // namespace

void runSweep(SweepRequest request, const std::string& command) {
  settleSweepRequest(request);
  makeSweepFolder(request.folder);

  Sweep sweep;
  SweepDescription description{.title = fmt::format("{}: sweep over {}", request.mesh.input.filename().string(),
                                                    namesOf(request.parameter()).key),
                               .command = command,
                               .pictures = {}};
  {
    ProgressBar bar(!request.mesh.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    const Monitor monitor{.progress = show, .stop = &interruptFlag()};
    sweep = contourAll(request, monitor);
    if (std::all_of(sweep.meshes.begin(), sweep.meshes.end(), [](const Mesh& m) { return m.empty(); }))
      throw Error(fmt::format("{}: no surface at any value; there is nothing to compare", request.mesh.input.string()));
    description.pictures = drawAll(request, sweep.meshes, monitor);
  }
  writeAll(request, sweep, description);
  if (!request.mesh.quiet) printSummary(request, sweep);
}

}  // namespace pdc
