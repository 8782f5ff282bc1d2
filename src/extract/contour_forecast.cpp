#include "pdc/extract/contour_forecast.h"

#include "extract/contour_memory.h"
#include "parallel/with_threads.h"

namespace pdc {

std::optional<ContourForecast> forecastContour(const HermiteSource& source, const ContourOptions& options,
                                               const Monitor& monitor) {
  return detail::withThreads(options.threads, [&]() -> std::optional<ContourForecast> {
    const std::optional<SurfaceForecast> surface = source.forecast(monitor);
    if (!surface) return std::nullopt;
    return ContourForecast{.vertices = surface->crossings,
                           .faces = surface->crossings * (options.triangles ? 2 : 1),
                           .memory = detail::contourMemory(surface->crossings, options) + surface->memory +
                                     detail::kBlockMemory * surface->blocks};
  });
}

}  // namespace pdc
