#pragma once

#include <optional>

#include "pdc/extract/contour.h"
#include "pdc/sample/hermite_source.h"

namespace pdc {

/// What a contour will take, estimated before any of the work.
struct ContourForecast {
  double vertices = 0;
  double faces = 0;   ///< Quads, or with ContourOptions::triangles triangles.
  double memory = 0;  ///< Bytes beyond those that are in use before.
};

/// Within a factor of two for most inputs; of formulas without bounds, only what looking for the surface takes is
/// known. Takes milliseconds, or as long as some ten thousand of a scene's bounds. \returns nothing if the source does
/// not know. \throws Cancelled, whatever the source throws.
[[nodiscard]] std::optional<ContourForecast> forecastContour(const HermiteSource& source,
                                                             const ContourOptions& options = {},
                                                             const Monitor& monitor = {});

}  // namespace pdc
