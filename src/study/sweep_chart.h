#pragma once

#include <string>
#include <vector>

#include "pdc/study/sweep.h"

namespace pdc::detail {

/// Curves that share a unit.
struct SweepChart {
  std::string title, unit;
  std::vector<std::string> keys;  ///< One to three columns, a curve each; see SweepColumn.
};

/// The charts of a sweep: those of which something is known.
[[nodiscard]] std::vector<SweepChart> sweepCharts(const Sweep& sweep);

/// Draws a chart as SVG that stands in a page. Values are evenly spaced along x, whatever they are, so that 0 and
/// infinity have a place; y begins at 0. The page gives the colours of the classes: c0, c1 and c2 are curves, `axis`
/// and `grid` lines; the element `.now` marks a step.
[[nodiscard]] std::string sweepChartSvg(const Sweep& sweep, const SweepChart& chart);

}  // namespace pdc::detail
