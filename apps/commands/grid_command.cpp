#include "commands/grid_command.h"

#include <fmt/format.h>

#include "files/json_file.h"
#include "parallel/stopwatch.h"
#include "parallel/with_threads.h"
#include "pdc/io/process_grid.h"
#include "pdc/io/vdb/vdb_writer.h"
#include "reports/json_report.h"
#include "requests/volume_request.h"
#include "terminal/busy_sign.h"
#include "terminal/interrupt.h"
#include "terminal/numbers.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

using Json = nlohmann::ordered_json;

/// What one run did. Seconds are wall-clock time.
struct GridRun {
  ProcessedGrid grid;
  std::size_t bytesWritten = 0;
  double secondsProcess = 0, secondsWrite = 0;
};

Json volumeJson(const ProcessedGrid& grid) {
  if (!grid.volumeFile) return {};
  return {{"format", grid.volumeFile->format}, {"space", grid.volumeFile->space}, {"unit", grid.volumeFile->unit}};
}

Json toJson(const MeshRequest& request, const GridRun& run) {
  const openvdb::GridBase& grid = *run.grid.volume.grid;
  const openvdb::Vec3d voxel = grid.voxelSize();
  return {{"input", shownPath(request.input)},
          {"output", shownPath(request.output)},
          {"name", grid.getName()},
          {"value_type", grid.valueType()},
          {"saved_as_half", grid.saveFloatAsHalf()},
          {"class", nameOf(run.grid.volume.gridClass)},
          {"voxel_size", {voxel.x(), voxel.y(), voxel.z()}},
          {"active_voxels", grid.activeVoxelCount()},
          {"steps", toJson(run.grid.steps)},
          {"volume", volumeJson(run.grid)},
          {"bytes", run.bytesWritten},
          {"seconds", {{"process", run.secondsProcess}, {"write", run.secondsWrite}}},
          {"warnings", run.grid.warnings}};
}

void printSummary(const MeshRequest& request, const GridRun& run) {
  for (const GridStepReport& step : run.grid.steps) {
    fmt::print("{} {}: {} active voxels, {} before", step.name, step.parameter, step.voxelsAfter, step.voxelsBefore);
    if (step.partsBefore > 0) fmt::print("; {} of {} parts", step.partsAfter, step.partsBefore);
    fmt::print("\n");
  }
  const openvdb::GridBase& grid = *run.grid.volume.grid;
  fmt::print("{}: a {} of {} active voxels; {} bytes\n", shownPath(request.output), nameOf(run.grid.volume.gridClass),
             grid.activeVoxelCount(), run.bytesWritten);
  fmt::print("{:.2f} s: reading and processing {:.2f}, writing {:.2f}\n", run.secondsProcess + run.secondsWrite,
             run.secondsProcess, run.secondsWrite);
}

}  // namespace

void addGridOptions(CLI::App& command, MeshRequest& request) {
  command
      .add_option("INPUT", request.input,
                  ".vdb, a volume (.nii.gz, .nrrd, .mha, .npy, ...),\nor a mesh with --mesh-to-level-set")
      ->required()
      ->type_name("");
  command.add_option("OUTPUT", request.output, ".vdb")->required()->type_name("");
  addGridSteps(command, request.steps, "Steps, in this order");
  const auto reading = "Reading";
  command.add_option("--grid", request.grid, "Grid to take, if the file has several")
      ->type_name("NAME")
      ->group(reading);
  addIso(command, request,
         "Where the surface is whose parts are kept or filled\n(level sets 0, fog volumes 0.5, dense ones otsu)")
      ->group(reading);
  addGridMeaning(command, request, reading);
  addNonFinite(command, request.acceptNonFinite)->group(reading);
  command.add_flag("--open", request.open, "Level sets are not closed where a box clips them")->group(reading);
  addVolumeOptions(command, request.volume, "For volumes");
  const auto output = "Output";
  command.add_option("--json", request.json, "Report for programs; - is standard output")
      ->type_name("FILE")
      ->group(output);
  command.add_flag("--quiet", request.quiet, "No summary and no progress bar")->group(output);
  addThreads(command, request.threads)->group(output);
  command.footer("Example: pdc grid smoke.vdb solid.vdb --fog-to-level-set 0.1 --smooth gaussian:0.2 --keep largest");
}

void runGrid(const MeshRequest& request) {
  checkVdbPath(request.output);
  if (request.kind() != InputKind::kVolume) refuseVolumeOptions(request.volume);
  checkJsonPath(request.json);
  checkJsonReplaces(request.json, request.input, request.output);
  GridRun run;
  detail::Stopwatch stopwatch;
  {
    // OpenVDB's reading and some of its tools cannot be asked to stop.
    const ExitOnInterrupt scope;
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    run.grid = detail::withThreads(request.threads.value_or(0), [&] {
      return processGrid(request.input, processOptions(request.input, request.inputOptions()),
                         {.progress = show, .stop = &interruptFlag()});
    });
  }
  run.secondsProcess = stopwatch.lap();
  for (const std::string& warning : run.grid.warnings)
    if (!request.quiet) printWarning(warning);
  {
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "writing " + request.output.filename().string());
    run.bytesWritten = writeVdb(run.grid.volume.grid, request.output);
  }
  run.secondsWrite = stopwatch.lap();
  writeJson(toJson(request, run), request.json);
  if (!request.quiet && request.json != "-") printSummary(request, run);
}

}  // namespace pdc
