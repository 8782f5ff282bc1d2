#pragma once

#include <openvdb/Grid.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pdc {

/// What a .vdb file says about one of its grids, and what its values are.
struct VdbGridInfo {
  std::string name;       ///< The name that readVdbGrid() takes: "name[1]" where grids share a name, "[0]" without one.
  std::string valueType;  ///< "float", "double", "int32", "int64", "bool", "vec3s", ...
  std::string gridClass;  ///< "level set", "fog volume", "unknown", "staggered".
  std::string transform;  ///< "uniform scale", "affine", "frustum", ...
  bool savedAsHalf = false;
  bool contourable = false;      ///< Whether the type is a scalar one that GridSource takes.
  std::size_t activeVoxels = 0;  ///< Tiles counted by their voxels; as the file notes it where not contourable.
  std::array<std::int32_t, 3> boundsLo{}, boundsHi{};  ///< Inclusive index-space box of active voxels; lo > hi if none.
  std::array<double, 3> voxelSize{};                   ///< In world units; for a frustum, at the origin.
  double background = 0, valueMin = 0, valueMax = 0;   ///< Zero where not contourable; min and max over active values.
};

/// All grids of a file, in file order. Values are read, so the cost is that of reading the file.
/// \throws Error for a missing, empty, damaged or non-VDB file.
[[nodiscard]] std::vector<VdbGridInfo> listVdbGrids(const std::filesystem::path& path);

/// Calls visit(info, grid) for all of these, each with the grid itself, which is null if it is not contourable and
/// given up when visit returns, unless that keeps it. \throws Error likewise, and what visit throws as an Error of the
/// file.
void visitVdbGrids(const std::filesystem::path& path,
                   const std::function<void(const VdbGridInfo& info, const openvdb::GridBase::Ptr& grid)>& visit);

/// One grid, wholly in memory (no delayed loading). An empty name takes the only contourable grid; if there is none or
/// more than one the error lists what there is. \throws Error for the files that listVdbGrids() refuses, for an unknown
/// name and for a type that cannot be contoured.
[[nodiscard]] openvdb::GridBase::Ptr readVdbGrid(const std::filesystem::path& path, const std::string& name = "");

/// A grid of a file, by what its table of contents says.
struct VdbGridName {
  std::string name, valueType;  ///< As in VdbGridInfo.
  bool contourable = false;     ///< As there.
  bool sampled = false;         ///< Whether readVdbAttribute() takes it.
};

/// The names of all grids of a file, in file order. No values are read. \throws Error as listVdbGrids().
[[nodiscard]] std::vector<VdbGridName> listVdbNames(const std::filesystem::path& path);

/// One grid whose values may be sampled, as gridAttribute() does: of a type that can be contoured, or of vectors of
/// three floats, doubles or int32. Otherwise as readVdbGrid(), but that the name must not be empty.
[[nodiscard]] openvdb::GridBase::Ptr readVdbAttribute(const std::filesystem::path& path, const std::string& name);

}  // namespace pdc
