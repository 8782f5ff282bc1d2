#include "commands/shading_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "files/mesh_file.h"
#include "pdc/error.h"
#include "pdc/mesh/distance.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

constexpr std::string_view kProperty = "property:";

/// The property's numbers, or its vectors' lengths.
Buffer<float> scalars(const VertexProperty& property) {
  const auto components = static_cast<std::size_t>(property.components);
  return std::visit(
      [&](const auto& numbers) {
        Buffer<float> result(numbers.size() / components);
        for (std::size_t i = 0; i < result.size(); ++i) {
          if (components == 1) {
            result[i] = static_cast<float>(numbers[i]);
            continue;
          }
          double squares = 0;
          for (std::size_t k = i * components; k < (i + 1) * components; ++k)
            squares += static_cast<double>(numbers[k]) * static_cast<double>(numbers[k]);
          result[i] = static_cast<float>(std::sqrt(squares));
        }
        return result;
      },
      property.values);
}

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
    shown.values = scalars(*property);
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
