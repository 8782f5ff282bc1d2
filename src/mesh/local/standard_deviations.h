#pragma once

#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The numbers of a property that holds standard deviations, one for each vertex. \throws Error if there is none of
/// that name, or it holds vectors, or for the first vertex with a number that is not finite and 0 or more.
[[nodiscard]] std::vector<double> standardDeviations(const Mesh& mesh, const std::string& name);

}  // namespace pdc::detail
