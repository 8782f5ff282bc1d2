#pragma once

#include <algorithm>
#include <vector>

#include "parallel/block_progress.h"
#include "smooth/smoothed_surface.h"

namespace pdc::detail {

/// Noise less the part that may be none: nothing up to `least`, all from twice as much on.
[[nodiscard]] inline double beyondDoubt(double sigma, double least) {
  return std::clamp(2 * (sigma - least), 0.0, sigma);
}

/// The standard deviation of each coordinate of each vertex, in mean edges, as the surface seems to have it there; 0
/// where that is less than what sampling does to clean surfaces.
///
/// Noise bends a surface to and fro from one vertex to the next. So it is found from how much the angle defects of the
/// vertices up to two edges away differ from their median, in the median: a spike, a corner or a crease is no more than
/// a few of some twenty there, and an even curvature is the median itself. Where the surface bends in one direction,
/// noise makes defects larger than on a plane; the distances of vertices from the mean of their neighbours do not have
/// that fault, but change along with curvature. Noise shows in both, and the lesser of the two figures counts.
/// \param progress advances by kMeasuringPasses times the number of vertices. \throws Cancelled.
[[nodiscard]] std::vector<double> measuredSigmas(const SmoothedSurface& surface, BlockProgress& progress);
inline constexpr std::size_t kMeasuringPasses = 3;

}  // namespace pdc::detail
