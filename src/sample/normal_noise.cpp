#include "pdc/sample/normal_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sample/surface_pairs.h"

namespace pdc {

double normalNoise(const HermiteSource& source, const Monitor& monitor) {
  std::vector<double> squares =
      detail::mapSurfacePairs<double>(source, monitor, [](const auto& a, const auto& b, auto& found) {
        const Vec3d d = a.normal - b.normal;
        if (a.normal != Vec3d{} && b.normal != Vec3d{}) found.push_back(dot(d, d));
      });
  if (squares.empty()) return 0;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  // A unit normal varies in two directions, its difference from another has twice the variance: |d|² is 2 σn² times a
  // chi-squared of two degrees of freedom, whose median is 2 ln 2.
  return std::sqrt(*middle / (4 * std::numbers::ln2));
}

}  // namespace pdc
