#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/yaml_value.h"
#include "pdc/field/field.h"

namespace pdc::detail {

/// What the shapes of a scene share while it is read.
struct SceneContext {
  std::filesystem::path folder;         ///< Where relative paths start.
  bool acceptNonFinite = false;         ///< Whether voxels of grids may be NaN or infinite.
  std::size_t shapes = 0;               ///< Number of shapes read so far; an alias counts each time it is used.
  int depth = 0;                        ///< Number of shapes around the current one.
  std::vector<std::string> warnings{};  ///< See Scene.
};

/// A kind of shape: its name in the file, and how its parameters make a field.
struct ShapeKind {
  std::string_view name;
  FieldPtr (*read)(const YamlValue& parameters, SceneContext& context);
};

[[nodiscard]] std::span<const ShapeKind> scenePrimitives();
[[nodiscard]] std::span<const ShapeKind> sceneOperators();
/// The shape `grid`. \throws YamlError, or Error where the .vdb file cannot be read.
[[nodiscard]] FieldPtr readGridShape(const YamlValue& parameters, SceneContext& context);
/// The shape `mesh`. \throws YamlError, or Error where the file cannot be read or has no triangles.
[[nodiscard]] FieldPtr readMeshShape(const YamlValue& parameters, SceneContext& context);

/// Reads a shape and all that is in it: a map with one key, the shape's name. \throws YamlError.
[[nodiscard]] FieldPtr readShape(const YamlValue& value, SceneContext& context);

}  // namespace pdc::detail
