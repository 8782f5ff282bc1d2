#include "simplify/error_bound/error_limits.h"

#include <fmt/format.h>

#include <cmath>

#include "mesh/mesh_checks.h"
#include "pdc/error.h"

namespace pdc::detail {

ErrorLimits errorLimits(const Mesh& mesh, const Buffer<Triangle>& faces, double distance, const std::string& property) {
  if (property.empty()) return ErrorLimits(distance);
  const std::vector<double> scales = scalarNumbers(mesh, property);
  for (std::size_t v = 0; v < scales.size(); ++v)
    if (!(scales[v] >= 0 && std::isfinite(static_cast<float>(scales[v]))))
      throw Error(fmt::format("the property '{}' of vertex {} is {}; the limit is a finite number >= 0", property, v,
                              scales[v]));
  std::vector<float> shares;
  shares.reserve(faces.size());
  for (const Triangle& t : faces)
    shares.push_back(static_cast<float>(std::min({scales[t[0]], scales[t[1]], scales[t[2]]})));
  return ErrorLimits(distance, std::move(shares));
}

}  // namespace pdc::detail
