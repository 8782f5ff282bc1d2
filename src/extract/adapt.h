#pragma once

#include "pdc/extract/contour.h"

namespace pdc::detail {

struct Adapted {
  Mesh mesh;
  std::size_t trianglesBefore = 0;
  double distance = 0;  ///< The largest from a vertex of either surface to the other.
};

/// A mesh of fewer faces within a distance of a contour: see ContourOptions::adaptive, which has to be set, and
/// adaptiveScale. With ContourOptions::triangles quads at which nothing was collapsed are split like the others. Runs
/// in parallel; the result does not depend on the number of threads. \param full left as it is, but changed on the way.
/// \param step that coordinates are multiples of; 0 for none. \throws Error for a scale that is none; Cancelled.
/// Progress: "decimate".
[[nodiscard]] Adapted adapt(Mesh& full, const ContourOptions& options, double step, const Monitor& monitor);

}  // namespace pdc::detail
