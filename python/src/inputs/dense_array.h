#pragma once

#include <pybind11/numpy.h>

#include "pdc/sample/dense/volume_view.h"
#include "pdc/sample/lattice_map.h"

namespace pdc::python {

/// A NumPy array of three dimensions as it lies in memory, which is looked at only while the array lives.
/// \throws py::type_error for element types other than bool, integers and floats of at most 64 bits.
[[nodiscard]] VolumeView viewOf(const pybind11::array& array);

/// The map of an affine matrix of 4 × 4 numbers that takes indices to the world. \throws Error if it is singular.
[[nodiscard]] LatticeMap mapOf(const pybind11::array_t<double>& affine);

}  // namespace pdc::python
