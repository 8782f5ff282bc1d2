#include "requests/volume_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "pdc/error.h"
#include "terminal/choice_option.h"
#include "terminal/numbers.h"

namespace pdc {
namespace {

const Choices<WorldFrame> kFrames{{"file", WorldFrame::kFile}, {"ras", WorldFrame::kRas}, {"lps", WorldFrame::kLps}};

CLI::Option* addIndex(CLI::App& command, const std::string& name, std::optional<std::int64_t>& target,
                      const std::string& help) {
  return command.add_option(name, target, help)
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
}

}  // namespace

void addVolumeOptions(CLI::App& command, VolumeReadOptions& volume, const std::string& group) {
  const auto takeRaw = [&volume](const std::string& text) {
    try {
      volume.raw = parseRawVolume(text);
    } catch (const Error& error) {
      throw CLI::ValidationError("--raw", error.what());
    }
  };
  command
      .add_option_function<std::string>(
          "--raw", takeRaw, "INPUT has no header: its sizes, x fastest, u8 i8 ... f64,\nle or be, and bytes to skip")
      ->type_name("XxYxZ:u16be[:SKIP]")
      ->group(group);
  command.add_option("--array", volume.array, "Array to take, if an .npz has several")->type_name("NAME")->group(group);
  command.add_option("--series", volume.series, "Series to take, if DICOM files have several")
      ->type_name("UID|N")
      ->group(group);
  addIndex(command, "--volume-index", volume.volumeIndex, "Volume to take, if there are several in time (0)")
      ->group(group);
  addIndex(command, "--channel", volume.channel, "Value to take, if points have several")->group(group);
  const auto takeSpacing = [&volume](const std::string& text) {
    const std::vector<double> s = parseReals(text, ',');
    if (s.size() != 3 || !std::all_of(s.begin(), s.end(), [](double v) { return v > 0 && std::isfinite(v); }))
      throw CLI::ValidationError("--spacing", fmt::format("'{}' is not X,Y,Z, three finite numbers above 0", text));
    volume.spacing = {s[0], s[1], s[2]};
  };
  command
      .add_option_function<std::string>("--spacing", takeSpacing, "From voxel to voxel along each axis (the file's)")
      ->type_name("X,Y,Z")
      ->group(group);
  addChoice(command, "--space", volume.frame, kFrames, "Frame of the mesh's coordinates (file): the file's, or turned")
      ->type_name("FRAME")
      ->group(group);
}

void refuseVolumeOptions(const VolumeReadOptions& volume) {
  const auto refuse = [](bool given, const char* name) {
    if (given) throw CLI::ValidationError(name, "goes with volumes only");
  };
  refuse(volume.raw.has_value(), "--raw");
  refuse(volume.array.has_value(), "--array");
  refuse(volume.series.has_value(), "--series");
  refuse(volume.volumeIndex.has_value(), "--volume-index");
  refuse(volume.channel.has_value(), "--channel");
  refuse(volume.spacing.has_value(), "--spacing");
  refuse(volume.frame != WorldFrame::kFile, "--space");
}

}  // namespace pdc
