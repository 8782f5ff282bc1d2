#pragma once

#include "pdc/extract/contour.h"

namespace pdc::detail {

struct Adapted {
  Mesh mesh;
  std::size_t trianglesBefore = 0;
  double distance = 0;  ///< The largest from a vertex of either surface to the other.
};

/// A mesh of fewer faces within a distance of a contour: see ContourOptions::adaptive. Runs in parallel; the result
/// does not depend on the number of threads. \param distance in world units. \param step that coordinates are multiples
/// of; 0 for none. \param triangles whether quads at which nothing was collapsed are to be split like the others.
/// \throws Cancelled. Progress: "decimate".
[[nodiscard]] Adapted adapt(const Mesh& full, double distance, double step, bool triangles, const Monitor& monitor);

}  // namespace pdc::detail
