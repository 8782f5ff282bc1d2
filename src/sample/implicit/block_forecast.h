#pragma once

#include "pdc/monitor.h"
#include "pdc/sample/surface_forecast.h"
#include "sample/implicit/block_search.h"

namespace pdc::detail {

/// What findSurfaceBlocks() will find, from some of the cubes that it will look at: where many are left on a level of
/// its descent, evenly spaced ones stand for all.
[[nodiscard]] SurfaceForecast forecastSurfaceBlocks(const BlockSearch& search, const Monitor& monitor);

}  // namespace pdc::detail
