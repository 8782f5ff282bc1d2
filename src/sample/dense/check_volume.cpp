#include "sample/dense/check_volume.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "pdc/error.h"
#include "pdc/sample/dense/dense_source.h"
#include "sample/dense/stored_scalars.h"

namespace pdc::detail {
namespace {

/// The largest size of a number that a type holds.
double mostOf(ScalarType type) {
  return visitScalar(type, []<typename Scalar>(Scalar) -> double {
    using Raw = typename Scalar::Raw;
    if constexpr (std::is_same_v<Scalar, HalfScalar>) {
      return 0;
    } else {
      return std::is_floating_point_v<Raw> ? 0 : static_cast<double>(std::numeric_limits<Raw>::max()) + 1;
    }
  });
}

}  // namespace

void checkVolume(const VolumeView& view, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t n = view.size[axis];
    if (n < 1 || n > kMostVolumePoints)
      throw Error(fmt::format("{} must have 1 to {} points along {}, not {}", what, kMostVolumePoints, "xyz"[axis], n));
  }
  if (view.data == nullptr) throw std::invalid_argument(std::string("DenseSource: no data for ") + what);
  if (!std::isfinite(view.slope) || view.slope == 0)
    throw Error(fmt::format("the slope of {} must be finite and not zero, not {}", what, view.slope));
  if (!std::isfinite(view.intercept))
    throw Error(fmt::format("the intercept of {} must be finite, not {}", what, view.intercept));
  if (!std::isfinite(std::abs(view.slope) * mostOf(view.type) + std::abs(view.intercept)))
    throw Error(fmt::format("with slope {} and intercept {} not all values of {} are finite", view.slope,
                            view.intercept, what));
}

}  // namespace pdc::detail
