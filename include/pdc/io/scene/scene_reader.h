#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pdc/field/field.h"

namespace pdc {

/// The answers a scene file says its mesh must give; each may be absent. Used by the tests.
struct SceneExpectation {
  std::optional<long long> eulerNumber;
  std::optional<double> area, volume;  ///< World units.
  double relativeTolerance = 0.01;     ///< For area and volume.
};

/// An implicit scene: where to look, how finely, and the function.
struct Scene {
  std::string name;      ///< Optional title.
  Box box{};             ///< World units.
  double voxelSize = 0;  ///< World units, > 0; from `voxel_size`, or the longest side of the box / `resolution`.
  std::optional<double> sigmaNormal;  ///< >= 0 or infinity.
  double iso = 0;
  FieldPtr field;
  SceneExpectation expect;
};

/// Reads a scene (YAML; the format is described in scenes/README.md). Relative paths inside are taken from the scene's
/// folder. \throws Error "FILE:LINE:COLUMN: what" for anything that is not exactly right: unknown or repeated keys,
/// missing or non-finite or out-of-range parameters, an empty box, files that cannot be read.
[[nodiscard]] Scene readScene(const std::filesystem::path& path);

}  // namespace pdc
