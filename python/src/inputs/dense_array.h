#pragma once

#include <pybind11/numpy.h>

#include <memory>

#include "pdc/sample/dense/volume_view.h"
#include "pdc/sample/lattice_map.h"

namespace pdc::python {

/// A NumPy array of three dimensions as it lies in memory, which is looked at only while the array lives.
/// \throws py::type_error for element types other than bool, integers and floats of at most 64 bits.
[[nodiscard]] VolumeView viewOf(const pybind11::array& array);

/// The values of a volume as an array that looks at them where they lie, read-only, before slope and intercept: `owner`
/// lives as long as the array and all arrays made of it.
[[nodiscard]] pybind11::array arrayOf(const VolumeView& view, const std::shared_ptr<const void>& owner);

/// The map of an affine matrix of 4 × 4 numbers that takes indices to the world. \throws Error if it is singular.
[[nodiscard]] LatticeMap mapOf(const pybind11::array_t<double>& affine);

}  // namespace pdc::python
