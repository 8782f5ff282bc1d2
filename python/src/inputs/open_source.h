#pragma once

#include <pybind11/pybind11.h>

#include "given_options.h"
#include "inputs/contour_run.h"

namespace pdc::python {

/// What opens a source: ("file", path), ("grid", grid, sigma grid or None, weight grid or None), ("field", field, the
/// six coordinates of its box, σn or None), ("mesh", mesh), ("volume", volume, arrays) or ("array", array, affine,
/// arrays), where `arrays` are those of sigma, weight and mask, or Nones. Called with the interpreter's lock held. The
/// tuple must live as long as what is opened. The request, too, names the source, as reports do.
[[nodiscard]] OpenInput openSource(const py::tuple& source, MeshRequest& request);

/// The same with further grids: "attribute_grids", pairs of a name and a grid, and "adaptive_scale", a grid.
[[nodiscard]] OpenInput withGrids(OpenInput open, const GivenOptions& options);

}  // namespace pdc::python
