#pragma once

#include <pybind11/pybind11.h>

#include "requests/mesh_request.h"

namespace pdc::python {

namespace py = pybind11;

/// What the program would be asked for with these options, named as pdc.contour() names them; None is not said.
/// \throws py::value_error for words and lengths that are none.
[[nodiscard]] MeshRequest requestOf(const py::dict& options);

}  // namespace pdc::python
