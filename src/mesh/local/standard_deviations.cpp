#include "mesh/local/standard_deviations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/mesh_checks.h"
#include "pdc/error.h"

namespace pdc::detail {

std::vector<double> standardDeviations(const Mesh& mesh, const std::string& name) {
  std::vector<double> numbers = scalarNumbers(mesh, name);
  const auto bad =
      std::find_if(numbers.begin(), numbers.end(), [](double sigma) { return !(sigma >= 0 && std::isfinite(sigma)); });
  if (bad != numbers.end())
    throw Error(fmt::format("the property '{}' of vertex {} is {}; the limit is a finite number >= 0", name,
                            bad - numbers.begin(), *bad));
  return numbers;
}

}  // namespace pdc::detail
