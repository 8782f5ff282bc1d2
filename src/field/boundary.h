#pragma once

#include <cmath>

/// What fields are on their zero set; see isInside().
namespace pdc::detail {

/// Relative size of the values that count as zero. Parts on round decimal numbers meet only up to the rounding of
/// coordinates, which may be a hundred times as large as the part; bounds have more room, see kRoundingSlack.
inline constexpr double kBoundary = 0x1p-44;

/// The value of a solid that holds its boundary: -0.0 within `tolerance` >= 0 of zero.
inline double closed(double value, double tolerance) { return std::abs(value) <= tolerance ? -0.0 : value; }

/// The value of a solid that does not hold its boundary: -0.0 becomes +0.0.
inline double open(double value) { return value + 0.0; }

}  // namespace pdc::detail
