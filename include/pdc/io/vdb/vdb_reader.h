#pragma once

#include <openvdb/Grid.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pdc {

/// What a .vdb file says about one of its grids, and what its values are.
struct VdbGridInfo {
  std::string name;       ///< As readVdbGrid takes it: "name[1]" where grids share a name, "[0]" without one.
  std::string valueType;  ///< "float", "double", "int32", "int64", "bool", "vec3s", ...
  std::string gridClass;  ///< "level set", "fog volume", "unknown", "staggered".
  std::string transform;  ///< "uniform scale", "affine", "frustum", ...
  bool savedAsHalf = false;
  bool contourable = false;  ///< A scalar type that GridSource takes.
  std::size_t activeVoxels = 0;
  std::array<std::int32_t, 3> boundsLo{}, boundsHi{};  ///< Inclusive index-space box of active voxels; lo > hi if none.
  std::array<double, 3> voxelSize{};                   ///< World units; at the origin for a frustum.
  double background = 0, valueMin = 0, valueMax = 0;   ///< Of contourable grids; min and max over active values.
};

/// All grids of a file, in file order. Values are read, so the cost is that of reading the file.
/// \throws Error for a missing, empty, damaged or non-VDB file.
[[nodiscard]] std::vector<VdbGridInfo> listVdbGrids(const std::filesystem::path& path);

/// One grid, wholly in memory (no delayed loading). An empty name takes the only contourable grid; if there is none or
/// more than one the error lists what there is. \throws Error as above, for an unknown name and for a type that cannot
/// be contoured.
[[nodiscard]] openvdb::GridBase::Ptr readVdbGrid(const std::filesystem::path& path, const std::string& name = "");

}  // namespace pdc
