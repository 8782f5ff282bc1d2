#pragma once

#include <pybind11/pybind11.h>

#include "inputs/contour_run.h"

namespace pdc::python {

namespace py = pybind11;

/// What opens a source: ("file", path), ("grid", grid, sigma grid or None, weight grid or None), ("field", field, the
/// six coordinates of its box, σn or None) or ("array", array, affine, sigma, weight and mask arrays or Nones). Called
/// with the interpreter's lock held. The tuple must live as long as what is opened. The request, too, names the source,
/// as reports do.
[[nodiscard]] OpenInput openSource(const py::tuple& source, MeshRequest& request);

}  // namespace pdc::python
