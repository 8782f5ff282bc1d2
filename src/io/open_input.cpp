#include "pdc/io/open_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/file/suffix.h"
#include "io/open_mesh.h"
#include "io/open_volume.h"
#include "io/vdb/grid_warnings.h"
#include "pdc/error.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_function.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

void refuseOther(bool given, const fs::path& path, const char* option, const char* takers) {
  if (given) throw Error(fmt::format("'{}': {} goes with {} only", path.string(), option, takers));
}

void refuseVolumeOptions(const fs::path& path, const InputOptions& options) {
  const auto volumes = "dense volumes";
  const VolumeReadOptions& volume = options.volume;
  refuseOther(options.isoFromOtsu, path, "Otsu's threshold", volumes);
  refuseOther(volume.array.has_value(), path, "an array's name", volumes);
  refuseOther(volume.series.has_value(), path, "a series", volumes);
  refuseOther(volume.volumeIndex.has_value(), path, "the index of a volume", volumes);
  refuseOther(volume.channel.has_value(), path, "a channel", volumes);
  refuseOther(volume.spacing.has_value(), path, "a spacing", volumes);
  refuseOther(volume.frame != WorldFrame::kFile, path, "a frame", volumes);
}

void checkNotOfMesh(const fs::path& path, const InputOptions& options) {
  refuseOther(options.offset.has_value(), path, "an offset of a mesh", "meshes");
  refuseOther(options.shell.has_value(), path, "a shell", "meshes");
}

/// What neither grids nor dense volumes have.
void refuseCellSize(const fs::path& path, const InputOptions& options) {
  refuseOther(options.voxelSize.has_value(), path, "a voxel size", "scenes and meshes");
  refuseOther(options.resolution.has_value(), path, "a resolution", "scenes and meshes");
  checkNotOfMesh(path, options);
}

void checkGridOptions(const fs::path& path, const InputOptions& options) {
  refuseVolumeOptions(path, options);
  refuseCellSize(path, options);
}

/// What goes with grids alone.
void refuseGridOptions(const fs::path& path, const InputOptions& options) {
  const auto grids = ".vdb inputs";
  refuseOther(options.grid.has_value(), path, "a grid's name", grids);
  refuseOther(options.floodFill, path, "flood filling", grids);
  refuseOther(options.sigmaGrid.has_value(), path, "a sigma grid", grids);
  refuseOther(options.weightGrid.has_value(), path, "a weight grid", grids);
  refuseOther(options.adaptiveGrid.has_value(), path, "an adaptive grid", grids);
  refuseOther(options.allAttributes || !options.attributes.empty(), path, "an attribute", grids);
}

void checkVolumeOptions(const fs::path& path, const InputOptions& options) {
  refuseGridOptions(path, options);
  refuseCellSize(path, options);
  if (options.isoFromOtsu && options.iso) throw Error("an isovalue excludes Otsu's threshold");
}

/// What neither scenes nor meshes have, and what both have.
void checkOptionsWithoutValues(const fs::path& path, const InputOptions& options) {
  refuseVolumeOptions(path, options);
  refuseGridOptions(path, options);
  const auto values = "grids and volumes";
  refuseOther(options.hermite != HermiteMode::kAuto, path, "a choice of planes", values);
  refuseOther(options.gridClass.has_value(), path, "a grid's class", values);
  refuseOther(options.inside.has_value(), path, "a side that is inside", values);
  if (options.voxelSize && options.resolution) throw Error("a voxel size excludes a resolution");
  if (options.resolution && (*options.resolution < 1 || *options.resolution > kMaxVoxelsPerAxis))
    throw Error(fmt::format("the resolution must be from 1 to {}, not {}", kMaxVoxelsPerAxis, *options.resolution));
}

void checkSceneOptions(const fs::path& path, const InputOptions& options) {
  checkOptionsWithoutValues(path, options);
  refuseOther(!options.steps.empty(), path, "what is done to grids", "grids and volumes");
  checkNotOfMesh(path, options);
}

void checkMeshOptions(const fs::path& path, const InputOptions& options) {
  checkOptionsWithoutValues(path, options);
  const auto others = "grids, volumes and scenes";
  refuseOther(options.iso.has_value(), path, "an isovalue", others);
  refuseOther(options.open, path, "an open surface", others);
  refuseOther(!options.steps.empty(), path, "what is done to grids", "grids and volumes");
}

std::string whyGridIsEmpty(const fs::path& path, const std::string& name, double iso) {
  for (const VdbGridInfo& grid : listVdbGrids(path)) {
    if (grid.name != name) continue;
    const auto [lo, hi] = std::minmax({grid.background, grid.activeVoxels > 0 ? grid.valueMin : grid.background,
                                       grid.activeVoxels > 0 ? grid.valueMax : grid.background});
    if (iso < lo || iso > hi)
      return fmt::format("iso {} is outside of the grid's values, {:.6g} to {:.6g}", iso, lo, hi);
  }
  return fmt::format("the grid has no surface at iso {}", iso);
}

/// A grid that says something of another one's values, or null. `role`: how errors call it.
openvdb::GridBase::ConstPtr readCompanion(const fs::path& path, const std::optional<std::string>& name,
                                          const openvdb::GridBase& grid, const char* role) {
  if (!name) return nullptr;
  if (name->empty()) throw Error(fmt::format("the name of the {} grid is empty", role));
  if (*name == grid.getName()) throw Error(fmt::format("the {} grid '{}' is the grid itself", role, *name));
  return readVdbGrid(path, *name);
}

/// The name of the grid that is contoured, as the file's list has it.
std::string ownName(const std::vector<VdbGridName>& names, const InputOptions& options) {
  if (options.grid && !options.grid->empty()) return *options.grid;
  return std::find_if(names.begin(), names.end(), [](const VdbGridName& n) { return n.contourable; })->name;
}

/// Reads what vertices are to have besides their places. Notes grids that are passed over.
void readAttributes(const fs::path& path, const InputOptions& options, Input& input) {
  if (!options.allAttributes && options.attributes.empty()) return;
  const std::vector<VdbGridName> names = listVdbNames(path);
  const std::string own = ownName(names, options);
  std::vector<std::string> wanted = options.attributes;
  if (options.allAttributes)
    for (const auto& [name, type, contourable, sampled] : names) {
      if (name == own) continue;
      if (sampled)
        wanted.push_back(name);
      else
        input.warnings.push_back(fmt::format("grid \"{}\" of type {} is no attribute", name, type));
    }
  for (const std::string& name : wanted) {
    if (name == own) throw Error(fmt::format("the attribute '{}' is the grid itself", name));
    if (std::count(wanted.begin(), wanted.end(), name) > 1)
      throw Error(fmt::format("the attribute '{}' is named twice", name));
    input.attributes.push_back({name, readVdbAttribute(path, name)});
  }
}

/// A grid and what came of the steps. Without steps readMeaning() has the file's own grid, and all that it doubts.
Input openProcessed(const fs::path& path, const InputOptions& options, const Monitor& monitor) {
  const bool dense = !options.meshToLevelSet && inputKind(path, options) == InputKind::kVolume;
  dense ? checkVolumeOptions(path, options) : checkGridOptions(path, options);
  const auto single = "grids without steps";
  refuseOther(options.sigmaGrid.has_value(), path, "a sigma grid", single);
  refuseOther(options.weightGrid.has_value(), path, "a weight grid", single);
  const auto vdb = ".vdb inputs";
  refuseOther(options.meshToLevelSet && options.adaptiveGrid, path, "an adaptive grid", vdb);
  refuseOther(options.meshToLevelSet && (options.allAttributes || !options.attributes.empty()), path, "an attribute",
              vdb);
  ProcessedGrid processed = processGrid(path, processOptions(path, options), monitor);
  const GridVolume& volume = processed.volume;
  auto source = std::make_unique<GridSource>(volume.grid, GridSourceOptions{.iso = volume.iso,
                                                                            .open = options.open,
                                                                            .acceptNonFinite = options.acceptNonFinite,
                                                                            .hermite = options.hermite,
                                                                            .gridClass = volume.gridClass,
                                                                            .inside = volume.inside});
  Input input;
  input.iso = source->iso();
  input.planeOrigin = source->usesDistances() ? PlaneOrigin::kDistance : PlaneOrigin::kGradient;
  input.valueNoise = source->valueNoise();
  input.meaning = source->meaning();
  input.steps = std::move(processed.steps);
  input.warnings = std::move(processed.warnings);
  input.whyEmpty = [iso = input.iso] { return fmt::format("the grid has no surface at iso {} after the steps", iso); };
  input.source = std::move(source);
  if (processed.volumeFile) input.volume = detail::describe(*processed.volumeFile);
  if (options.meshToLevelSet || dense) return input;
  if (const auto scale = readCompanion(path, options.adaptiveGrid, *volume.grid, "adaptive"))
    input.adaptiveScale = gridFunction(scale);
  readAttributes(path, options, input);
  return input;
}

Input openGrid(const fs::path& path, const InputOptions& options) {
  checkGridOptions(path, options);
  const auto grid = readVdbGrid(path, options.grid.value_or(""));
  auto source = std::make_unique<GridSource>(
      grid, GridSourceOptions{.iso = options.iso,
                              .open = options.open,
                              .acceptNonFinite = options.acceptNonFinite,
                              .hermite = options.hermite,
                              .sigma = readCompanion(path, options.sigmaGrid, *grid, "sigma"),
                              .weight = readCompanion(path, options.weightGrid, *grid, "weight"),
                              .gridClass = options.gridClass,
                              .inside = options.inside,
                              .floodFill = options.floodFill});
  Input input;
  if (const auto scale = readCompanion(path, options.adaptiveGrid, *grid, "adaptive"))
    input.adaptiveScale = gridFunction(scale);
  input.iso = source->iso();
  input.planeOrigin = source->usesDistances() ? PlaneOrigin::kDistance : PlaneOrigin::kGradient;
  input.valueNoise = source->valueNoise();
  input.refusedNoise = source->refusedNoise();
  input.crossingsWithoutData = source->crossingsWithoutData();
  input.meaning = source->meaning();
  input.warnings = detail::gridWarnings(source->meaning(), detail::OptionStyle::kProgram);
  readAttributes(path, options, input);
  input.whyEmpty = [path, name = grid->getName(), iso = input.iso] { return whyGridIsEmpty(path, name, iso); };
  input.source = std::move(source);
  return input;
}

Input openDense(const fs::path& path, const InputOptions& options, const Monitor& monitor) {
  checkVolumeOptions(path, options);
  return detail::inputOf(detail::openVolume(path,
                                            {.read = options.volume,
                                             .source = {.iso = options.iso,
                                                        .open = options.open,
                                                        .acceptNonFinite = options.acceptNonFinite,
                                                        .hermite = options.hermite,
                                                        .gridClass = options.gridClass,
                                                        .inside = options.inside},
                                             .isoFromOtsu = options.isoFromOtsu},
                                            monitor));
}

double longestSide(const Box& box) {
  const Vec3d size = box.hi - box.lo;
  return std::max({size.x, size.y, size.z});
}

Input openScene(const fs::path& path, const InputOptions& options) {
  checkSceneOptions(path, options);
  Scene scene = readScene(path, options.acceptNonFinite);
  double voxelSize = options.voxelSize.value_or(scene.voxelSize);
  if (options.resolution) voxelSize = longestSide(scene.box) / *options.resolution;
  Input input;
  input.iso = options.iso.value_or(scene.iso);
  input.sigmaNormal = scene.sigmaNormal;
  input.warnings = std::move(scene.warnings);
  auto source =
      std::make_unique<FieldSource>(scene.field, FieldSourceOptions{.box = scene.box,
                                                                    .voxelSize = voxelSize,
                                                                    .iso = input.iso,
                                                                    .open = options.open,
                                                                    .acceptNonFinite = scene.acceptNonFinite});
  input.field = source->levelField();
  if (!options.open) input.cut = scene.box;
  input.planeOrigin = PlaneOrigin::kFunction;
  input.whyEmpty = [iso = input.iso] { return fmt::format("the scene has no surface at iso {} in its box", iso); };
  input.source = std::move(source);
  return input;
}

}  // namespace

InputKind inputKind(const fs::path& path) {
  const std::string suffix = detail::suffixOf(path);
  if (suffix == ".vdb") return InputKind::kGrid;
  if (suffix == ".yaml" || suffix == ".yml") return InputKind::kScene;
  const fs::path plain = suffix == ".gz" ? path.stem() : path;
  for (const char* mesh : {".ply", ".obj", ".off", ".stl"})
    if (detail::suffixOf(plain) == mesh) return InputKind::kMesh;
  return isVolumeFile(path) ? InputKind::kVolume : InputKind::kOther;
}

InputKind inputKind(const fs::path& path, const InputOptions& options) {
  return options.volume.raw ? InputKind::kVolume : inputKind(path);
}

std::string_view planeOriginName(PlaneOrigin origin) {
  switch (origin) {
    case PlaneOrigin::kGradient:
      return "gradient";
    case PlaneOrigin::kDistance:
      return "distance";
    case PlaneOrigin::kFunction:
      return "function";
    case PlaneOrigin::kTriangle:
      return "triangle";
  }
  return "";
}

ProcessGridOptions processOptions(const fs::path& path, const InputOptions& options) {
  const bool dense = inputKind(path, options) == InputKind::kVolume;
  return {.grid = options.grid.value_or(""),
          .settle = {.meaning = {.iso = options.iso,
                                 .gridClass = options.gridClass,
                                 .inside = options.inside,
                                 .floodFill = options.floodFill},
                     .acceptNonFinite = options.acceptNonFinite},
          .steps = options.steps,
          .meshToLevelSet = options.meshToLevelSet,
          .volume = dense ? std::optional(options.volume) : std::nullopt,
          .isoFromOtsu = options.isoFromOtsu};
}

Input openInput(const fs::path& path, const InputOptions& options, const Monitor& monitor) {
  if (options.meshToLevelSet) return openProcessed(path, options, monitor);
  switch (inputKind(path, options)) {
    case InputKind::kVolume:
      return options.steps.empty() ? openDense(path, options, monitor) : openProcessed(path, options, monitor);
    case InputKind::kGrid:
      return options.steps.empty() ? openGrid(path, options) : openProcessed(path, options, monitor);
    case InputKind::kScene:
      return openScene(path, options);
    case InputKind::kMesh:
      checkMeshOptions(path, options);
      return detail::openMesh(path, options, monitor);
    case InputKind::kOther:
      break;
  }
  throw Error(fmt::format(
      "'{}': not a kind of input; the suffix must be .vdb, .yaml, .yml, .ply, .obj, .off, .stl or a volume's",
      path.string()));
}

}  // namespace pdc
