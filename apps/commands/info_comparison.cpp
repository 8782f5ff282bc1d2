#include "commands/info_comparison.h"

#include <fmt/format.h>

#include "files/mesh_file.h"
#include "pdc/error.h"
#include "pdc/mesh/mesh_comparison.h"
#include "reports/info_facts.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

MeshFile readShown(const std::filesystem::path& path, bool quiet) {
  const ExitOnInterrupt scope;
  const BusySign sign(!quiet, "reading " + path.filename().string());
  return readMeshFile(path);
}

Json toJson(const DistanceFigures& figures) {
  return {{"mean", figures.mean},
          {"rms", figures.rms},
          {"p99.9", figures.p999},
          {"largest", figures.largest},
          {"samples", figures.samples}};
}

Json toJson(const MeshComparison& comparison, const std::filesystem::path& reference) {
  return {{"file", reference.string()},
          {"to_reference", toJson(comparison.toReference)},
          {"from_reference", toJson(comparison.fromReference)},
          {"normal_angle_degrees", {{"mean", comparison.meanAngle}, {"rms", comparison.rmsAngle}}},
          {"opposed_share", comparison.opposedShare}};
}

}  // namespace

Json compareFiles(const InfoRequest& request) {
  constexpr std::int64_t kMost = 1'000'000'000;
  if (request.samples < 1 || request.samples > kMost)
    throw Error(fmt::format("--samples is {}, must be 1 to {}", request.samples, kMost));
  const MeshFile file = readShown(request.file, request.quiet);
  const MeshFile reference = readShown(request.reference, request.quiet);
  Json facts{{"file", shownPath(request.file)}};
  {
    const ExitOnInterrupt scope;
    facts.update(meshFileFacts(file));
  }
  for (const std::string& warning : reference.warnings) facts["warnings"].push_back(warning);
  ProgressBar bar(!request.quiet);
  const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
  const MeshComparison comparison =
      compareMeshes(file.mesh, reference.mesh, {.samples = static_cast<std::size_t>(request.samples)},
                    {.progress = show, .stop = &interruptFlag()});
  facts["reference"] = toJson(comparison, request.reference);
  return facts;
}

}  // namespace pdc
