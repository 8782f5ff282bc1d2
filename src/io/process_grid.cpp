#include "pdc/io/process_grid.h"

#include <fmt/format.h>

#include "io/open_volume.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/error.h"
#include "pdc/grid/grid_from_volume.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/io/vdb/vdb_reader.h"

namespace pdc {
namespace {

GridVolume openMesh(const Mesh& mesh, const MeshToLevelSetOptions& options, std::vector<GridStepReport>& steps,
                    const Monitor& monitor) {
  GridStepReport report;
  report.name = "mesh-to-level-set";
  report.parameter = fmt::format("{}", options.voxelSize);
  if (options.halfWidth > 0) report.parameter += fmt::format(":{}", options.halfWidth);
  GridVolume volume = meshToLevelSet(mesh, options, &report, monitor);
  steps.push_back(std::move(report));
  return volume;
}

GridVolume openGrid(openvdb::GridBase::Ptr grid, const ProcessGridOptions& options,
                    std::vector<std::string>& warnings) {
  SettleOptions settle = options.settle;
  if (options.steps.fogToLevelSet) settle.meaning.iso = options.steps.fogToLevelSet;
  GridMeaning meaning;
  GridVolume volume = settleGrid(std::move(grid), settle, &meaning);
  warnings = detail::gridWarnings(meaning, detail::OptionStyle::kProgram);
  return volume;
}

/// The volume as a grid that carries what its values were taken for.
GridVolume openDense(const std::filesystem::path& path, const ProcessGridOptions& options, ProcessedGrid& result,
                     const Monitor& monitor) {
  const GridMeaningOptions& asked = options.settle.meaning;
  detail::OpenedVolume opened = detail::openVolume(path,
                                                   {.read = *options.volume,
                                                    .source = {.iso = asked.iso,
                                                               .acceptNonFinite = options.settle.acceptNonFinite,
                                                               .gridClass = asked.gridClass,
                                                               .inside = asked.inside},
                                                    .isoFromOtsu = options.isoFromOtsu},
                                                   monitor);
  result.warnings = std::move(opened.warnings);
  const GridMeaning& meaning = opened.source->meaning();
  const double outside = meaning.inside == InsideValues::kHigh ? meaning.lowest : meaning.highest;
  openvdb::GridBase::Ptr grid = gridFromVolume(opened.volume.view, opened.volume.linear, opened.volume.translation,
                                               static_cast<float>(outside), monitor);
  ProcessGridOptions known = options;
  known.settle.meaning.iso = opened.source->iso();
  known.settle.meaning.gridClass = meaning.gridClass;
  known.settle.meaning.inside = meaning.inside;
  opened.source.reset();
  opened.volume.view.data = nullptr;
  opened.volume.owner.reset();
  result.volumeFile = std::move(opened.volume);
  std::vector<std::string> sameAgain;
  return openGrid(std::move(grid), known, sameAgain);
}

/// Calls work(), and puts the file's name before what it complains of.
template <typename Work>
auto withName(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

ProcessedGrid processGrid(const std::filesystem::path& path, const ProcessGridOptions& options,
                          const Monitor& monitor) {
  ProcessedGrid result;
  if (options.meshToLevelSet) {
    const Mesh mesh = readMesh(path, {.warn = [&](const std::string& line) { result.warnings.push_back(line); }});
    result.volume = withName(path, [&] { return openMesh(mesh, *options.meshToLevelSet, result.steps, monitor); });
  } else if (options.volume) {
    result.volume = openDense(path, options, result, monitor);
  } else {
    openvdb::GridBase::Ptr grid = readVdbGrid(path, options.grid);
    result.volume = withName(path, [&] { return openGrid(std::move(grid), options, result.warnings); });
  }
  withName(path, [&] { applyGridSteps(result.volume, options.steps, &result.steps, monitor); });
  if (options.steps.fogToLevelSet) result.volume.iso = options.settle.meaning.iso.value_or(0);
  for (const GridStepReport& step : result.steps)
    for (const std::string& warning : step.warnings) result.warnings.push_back(step.name + ": " + warning);
  return result;
}

}  // namespace pdc
