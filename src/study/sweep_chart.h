#pragma once

#include <string>
#include <vector>

#include "pdc/study/sweep.h"

namespace pdc::detail {

/// Curves that share a unit.
struct SweepChart {
  std::string title, unit;
  std::vector<std::string> keys;  ///< Columns; at most three.
};

/// The charts of a sweep: those of which something is known.
[[nodiscard]] std::vector<SweepChart> sweepCharts(const Sweep& sweep);

/// As SVG to stand in a page: values evenly spaced along x, whatever they are, so that 0 and infinity have a place; y
/// from 0. Colours are the page's: classes c0, c1, c2 for curves, and `axis`, `grid`; element `.now` marks a step.
[[nodiscard]] std::string sweepChartSvg(const Sweep& sweep, const SweepChart& chart);

}  // namespace pdc::detail
