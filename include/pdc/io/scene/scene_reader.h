#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pdc/field/field.h"

namespace pdc {

/// What a scene file says about its mesh, for tests to hold it to; each answer may be absent.
struct SceneExpectation {
  std::optional<long long> eulerNumber;
  std::optional<double> area, volume;  ///< In world units squared and cubed, > 0.
  double relativeTolerance = 0.01;     ///< Of area and volume, > 0.
};

/// An implicit scene: where to look, how finely, and the function.
struct Scene {
  std::string name;      ///< A title; empty without one.
  Box box{};             ///< In world units; lo < hi on every axis.
  double voxelSize = 0;  ///< In world units, > 0: `voxel_size`, or the longest edge of the box / `resolution`.
  std::optional<double> sigmaNormal;  ///< Standard deviation of the normals' components, >= 0 or infinite.
  double iso = 0;                     ///< The surface is where the field has this value.
  bool acceptNonFinite = false;       ///< Where the field is not finite it is outside; see FieldSourceOptions.
  FieldPtr field;                     ///< Never null.
  SceneExpectation expect;
  std::vector<std::string> warnings;  ///< Where a grid's values may mean something else: a line each.
};

/// Reads a scene (YAML; the format is described in scenes/README.md). Relative paths inside are taken from the scene's
/// folder. \throws Error "FILE:LINE:COLUMN: what" for anything that is not exactly right: unknown or repeated keys,
/// missing or non-finite or out-of-range parameters, an empty box, files that cannot be read, grids with voxels that
/// are not finite and not accepted.
/// \param acceptNonFinite Scene::acceptNonFinite is true whatever the file says.
[[nodiscard]] Scene readScene(const std::filesystem::path& path, bool acceptNonFinite = false);

}  // namespace pdc
