#pragma once

#include <functional>
#include <memory>
#include <string>

#include "commands/mesh_request.h"
#include "pdc/field/field.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

/// An input that is ready to be contoured.
struct MeshInput {
  std::unique_ptr<const HermiteSource> source;
  double iso = 0;
  double sigmaNormal = 0;        ///< What the input says, or the library's default.
  FieldPtr field;                ///< Of a scene: zero on the surface that the mesh should have. Null of a grid.
  std::string hermite;           ///< Where planes come from: gradient, distance or function.
  double valueNoise = 0;         ///< In voxels, as far as it was estimated.
  std::size_t refusedNoise = 0;  ///< Values of the σ and weight grids that are negative or not finite.
  std::function<std::string()> whyEmpty;  ///< Says in a clause why there is no surface; may read the file again.
};

/// Reads the grid or the scene. \throws Error.
[[nodiscard]] MeshInput openMeshInput(const MeshRequest& request);

}  // namespace pdc
