#include "commands/pictures/shading_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/mesh_file.h"
#include "mesh/local/magnitudes.h"
#include "pdc/error.h"
#include "pdc/mesh/distance.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

constexpr std::string_view kProperty = "property:";

Buffer<float> distancesTo(const std::filesystem::path& reference, const Mesh& mesh, const Monitor& monitor) {
  Buffer<float> values;
  for (const double d : vertexDistances(mesh, readMeshFile(reference).mesh, monitor))
    values.push_back(static_cast<float>(d));
  return values;
}

}  // namespace

bool isValueShading(std::string_view shading) {
  return shading == "confidence" || shading == "error" ||
         (shading.starts_with(kProperty) && shading.size() > kProperty.size());
}

ShadingValues shadingValues(const RenderRequest& request, const Mesh& mesh, const Monitor& monitor) {
  const bool named = request.shading.starts_with(kProperty);
  ShadingValues shown;
  shown.name = named ? request.shading.substr(kProperty.size()) : request.shading;
  if (!request.reference.empty()) {
    shown.values = distancesTo(request.reference, mesh, monitor);
  } else if (const VertexProperty* const property = mesh.property(shown.name)) {
    shown.values = detail::magnitudes(*property);
  } else {
    throw Error(fmt::format("{}: its vertices have no property \"{}\"{}", shownPath(request.mesh), shown.name,
                            request.shading == "error" ? "; give one, or a --reference" : ""));
  }
  if (request.shading == "confidence") {
    shown.hi = 1;
    return shown;
  }
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float lo = named ? kInfinity : 0, hi = named ? -kInfinity : 0;
  for (const float v : shown.values)
    if (std::isfinite(v)) {
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  // Errors are drawn from 0 on, and so is a property without a finite value.
  shown.lo = named && lo <= hi ? lo : 0;
  shown.hi = lo <= hi ? hi : 0;
  return shown;
}

}  // namespace pdc
