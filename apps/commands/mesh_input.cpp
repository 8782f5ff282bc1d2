#include "commands/mesh_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands/input_kind.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/io/vdb/vdb_reader.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {
namespace {

std::string whyGridIsEmpty(const std::filesystem::path& path, const std::string& name, double iso) {
  for (const VdbGridInfo& grid : listVdbGrids(path)) {
    if (grid.name != name) continue;
    const auto [lo, hi] = std::minmax({grid.background, grid.activeVoxels > 0 ? grid.valueMin : grid.background,
                                       grid.activeVoxels > 0 ? grid.valueMax : grid.background});
    if (iso < lo || iso > hi)
      return fmt::format("iso {} is outside of the grid's values, {:.6g} to {:.6g}", iso, lo, hi);
  }
  return fmt::format("the grid has no surface at iso {}", iso);
}

HermiteMode hermiteMode(const MeshRequest& request) {
  if (request.hermite == "gradient") return HermiteMode::kGradient;
  return request.hermite == "distance" ? HermiteMode::kDistance : HermiteMode::kAuto;
}

/// A grid that says something of another one's values, or null.
openvdb::GridBase::ConstPtr readCompanion(const MeshRequest& request, const std::optional<std::string>& name,
                                          const openvdb::GridBase& grid, const char* option) {
  if (!name) return nullptr;
  if (name->empty()) throw Error(fmt::format("{}: the name is empty", option));
  if (*name == grid.getName()) throw Error(fmt::format("{}: '{}' is the grid itself", option, *name));
  return readVdbGrid(request.input, *name);
}

MeshInput openGrid(const MeshRequest& request) {
  const auto grid = readVdbGrid(request.input, request.grid.value_or(""));
  auto source = std::make_unique<GridSource>(
      grid, GridSourceOptions{.iso = request.iso,
                              .open = request.open,
                              .acceptNonFinite = request.nan == "outside",
                              .hermite = hermiteMode(request),
                              .sigma = readCompanion(request, request.sigmaGrid, *grid, "--sigma-grid"),
                              .weight = readCompanion(request, request.weightGrid, *grid, "--weight-grid")});
  const double iso = source->iso(), noise = source->valueNoise();
  const std::size_t refused = source->refusedNoise();
  const auto hermite = source->usesDistances() ? "distance" : "gradient";
  return {.source = std::move(source),
          .iso = iso,
          .sigmaNormal = kDefaultSigmaNormal,
          .field = nullptr,
          .hermite = hermite,
          .valueNoise = noise,
          .refusedNoise = refused,
          .whyEmpty = [path = request.input, name = grid->getName(), iso] { return whyGridIsEmpty(path, name, iso); }};
}

double longestSide(const Box& box) {
  const Vec3d size = box.hi - box.lo;
  return std::max({size.x, size.y, size.z});
}

MeshInput openScene(const MeshRequest& request) {
  const Scene scene = readScene(request.input);
  double voxelSize = request.voxelSize.value_or(scene.voxelSize);
  if (request.resolution) voxelSize = longestSide(scene.box) / *request.resolution;
  const double iso = request.iso.value_or(scene.iso);
  auto source = std::make_unique<FieldSource>(
      scene.field, FieldSourceOptions{.box = scene.box, .voxelSize = voxelSize, .iso = iso, .open = request.open});
  const FieldPtr field = source->levelField();
  return {.source = std::move(source),
          .iso = iso,
          .sigmaNormal = scene.sigmaNormal.value_or(kDefaultSigmaNormal),
          .field = field,
          .hermite = "function",
          .whyEmpty = [iso] { return fmt::format("the scene has no surface at iso {} in its box", iso); }};
}

}  // namespace

MeshInput openMeshInput(const MeshRequest& request) {
  return inputKind(request.input) == InputKind::kGrid ? openGrid(request) : openScene(request);
}

}  // namespace pdc
