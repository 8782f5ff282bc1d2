#include "io/open_volume.h"

#include <fmt/format.h>

#include <utility>

#include "io/file/file_error.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/error.h"
#include "pdc/sample/dense/value_histogram.h"

namespace pdc::detail {
namespace {

/// Says what is doubtful; where grids have a class, and something around them, the words are others.
std::vector<std::string> volumeWarnings(GridMeaning meaning) {
  std::vector<std::string> lines;
  std::erase_if(meaning.doubts, [&](GridDoubt doubt) {
    if (doubt == GridDoubt::kIsoGuessed)
      lines.push_back(fmt::format(
          "values from {:.6g} to {:.6g} do not say where the surface is; Otsu's threshold, {:.6g}, was taken; --iso V "
          "sets it",
          meaning.lowest, meaning.highest, meaning.iso));
    else if (doubt == GridDoubt::kClassUnclear)
      lines.push_back(fmt::format(
          "values from {:.6g} to {:.6g} are no distances with a sign; they were taken as a {} at iso {:.6g}; --class "
          "level-set|fog and --iso V set it",
          meaning.lowest, meaning.highest, nameOf(meaning.gridClass), meaning.iso));
    else if (doubt == GridDoubt::kPositiveInside)
      lines.push_back(
          "all outermost values are negative, so positive ones were taken as inside; --inside low if everything around "
          "is solid");
    else
      return false;
    return true;
  });
  for (std::string& line : gridWarnings(meaning, OptionStyle::kProgram)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace

OpenedVolume openVolume(DenseVolume volume, const OpenVolumeOptions& options, const Monitor& monitor) {
  DenseSourceOptions source = options.source;
  if (options.isoFromOtsu) {
    const auto threshold = otsuThreshold(volume.view, monitor);
    if (!threshold) throw Error("all values are equal, or none is finite, so they have no threshold");
    source.iso = threshold->value;
  }
  OpenedVolume opened{.volume = std::move(volume), .source = nullptr, .warnings = {}};
  opened.source = std::make_unique<const DenseSource>(
      opened.volume.view, LatticeMap(opened.volume.linear, opened.volume.translation), source, opened.volume.owner);
  opened.warnings = opened.volume.warnings;
  for (std::string& line : volumeWarnings(opened.source->meaning())) opened.warnings.push_back(std::move(line));
  return opened;
}

OpenedVolume openVolume(const std::filesystem::path& path, const OpenVolumeOptions& options, const Monitor& monitor) {
  DenseVolume volume = readVolume(path, options.read, monitor);
  try {
    return openVolume(std::move(volume), options, monitor);
  } catch (const Error& error) {
    throw fileError(path, error.what());
  }
}

Input inputOf(OpenedVolume opened) {
  const DenseSource& source = *opened.source;
  const DenseVolume& volume = opened.volume;
  Input input;
  input.iso = source.iso();
  input.planeOrigin = source.usesDistances() ? PlaneOrigin::kDistance : PlaneOrigin::kGradient;
  input.valueNoise = source.valueNoise();
  input.refusedNoise = source.refusedNoise();
  input.meaning = source.meaning();
  input.volume = describe(volume);
  input.warnings = std::move(opened.warnings);
  input.whyEmpty = [view = volume.view, owner = volume.owner, iso = input.iso] {
    const ValueHistogram values = valueHistogram(view, 1);
    if (values.finite > 0 && (iso < values.lowest || iso > values.highest))
      return fmt::format("iso {} is outside of the volume's values, {:.6g} to {:.6g}", iso, values.lowest,
                         values.highest);
    return fmt::format("the volume has no surface at iso {}", iso);
  };
  input.source = std::move(opened.source);
  return input;
}

InputVolume describe(const DenseVolume& volume) {
  return {volume.format, volume.encoding, volume.space, volume.unit, volume.orientation, volume.view.size};
}

}  // namespace pdc::detail
