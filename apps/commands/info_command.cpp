#include "commands/info_command.h"

#include "commands/info_comparison.h"
#include "files/json_file.h"
#include "pdc/io/open_input.h"
#include "pdc/io/png_writer.h"
#include "reports/info_facts.h"
#include "reports/volume_facts.h"
#include "requests/volume_request.h"
#include "terminal/busy_sign.h"
#include "terminal/facts_text.h"
#include "terminal/interrupt.h"
#include "terminal/progress_bar.h"
#include "terminal/shown_path.h"
#include "terminal/warning.h"

namespace pdc {
namespace {

bool isVolume(const InfoRequest& request) {
  return request.reference.empty() && (request.volume.raw || inputKind(request.file) == InputKind::kVolume);
}

nlohmann::ordered_json describeVolume(const InfoRequest& request) {
  if (!request.histogram.empty()) checkPngPath(request.histogram);
  nlohmann::ordered_json facts{{"file", shownPath(request.file)}};
  const VolumeFacts volume = [&] {
    ProgressBar bar(!request.quiet);
    const auto show = [&bar](const char* stage, double share) { bar.update(stage, share); };
    return gatherVolumeFacts(request.file, request.volume, {.progress = show, .stop = &interruptFlag()});
  }();
  facts.update(volume.facts);
  if (!request.histogram.empty()) writePng(drawHistogram(volume.histogram, volume.threshold), request.histogram);
  for (const auto& line : facts.at("warnings")) printWarning(line.get<std::string>());
  return facts;
}

}  // namespace

void addInfoOptions(CLI::App& command, InfoRequest& request) {
  command
      .add_option(
          "FILE", request.file,
          ".vdb, a volume (.nii.gz, .nrrd, .mha, .npy, ...), a scene\n(.yaml, .yml), or a mesh: .ply, .obj, .off, .stl")
      ->required()
      ->type_name("");
  CLI::Option* reference = command.add_option("--reference", request.reference,
                                              "Mesh to compare with: distances and angles between the two");
  reference->type_name("MESH");
  command.add_option("--samples", request.samples, "Points on each of the two surfaces (1000000)")
      ->type_name("N")
      ->needs(reference);
  command.add_option("--json", request.json, "The same for programs; - is standard output")->type_name("FILE");
  command.add_option("--histogram", request.histogram, "Of a volume: a picture of how often its values occur")
      ->type_name("FILE.png");
  addVolumeOptions(command, request.volume, "For volumes");
  command.add_flag("--quiet", request.quiet, "No word on standard error while a large file is read, no progress bar");
}

void runInfo(const InfoRequest& request) {
  checkJsonPath(request.json);
  nlohmann::ordered_json facts;
  if (isVolume(request)) {
    facts = describeVolume(request);
  } else if (!request.histogram.empty()) {
    throw CLI::ValidationError("--histogram", "goes with volumes only");
  } else if (request.reference.empty()) {
    refuseVolumeOptions(request.volume);
    const ExitOnInterrupt scope;
    const BusySign sign(!request.quiet, "reading " + request.file.filename().string());
    facts = gatherFacts(request.file);
  } else {
    facts = compareFiles(request);
  }
  const ExitOnInterrupt scope;
  if (request.json.empty()) {
    facts.erase("warnings");  // They are on standard error already.
    const nlohmann::ordered_json all = facts;
    if (isVolume(request)) facts.erase("histogram");
    printFacts(facts);
    if (isVolume(request)) printHistogram(all);
  } else {
    writeJson(facts, request.json);
  }
}

}  // namespace pdc
