#pragma once

#include <string>
#include <string_view>

#include "commands/pictures/render_command.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

/// What `pdc render` colours a mesh by: a number per vertex.
struct ShadingValues {
  std::string name;
  Buffer<float> values;
  float lo = 0, hi = 0;  ///< The ends of the colours.
};

/// Whether a --shading colours by numbers: confidence, error and property:NAME do.
[[nodiscard]] bool isValueShading(std::string_view shading);

/// The numbers of a shading that isValueShading() and where its colours end: 0 and 1 for confidence, 0 and the largest
/// finite value for error, the smallest and the largest for property:NAME. A vector counts by its length.
/// \throws Error if the mesh has no such property or the reference cannot be read; Cancelled.
[[nodiscard]] ShadingValues shadingValues(const RenderRequest& request, const Mesh& mesh, const Monitor& monitor);

}  // namespace pdc
