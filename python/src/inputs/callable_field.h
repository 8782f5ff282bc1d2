#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "pdc/field/field.h"

namespace pdc::python {

/// What Python holds of a field. Python's classes cannot hold pointers to constants.
struct FieldHandle {
  FieldPtr field;
};

/// A field of a Python function f(points) → values, points being an array of shape (n, 3). It is called with up to some
/// thousand points at a time, on whichever thread needs them, under the interpreter's lock. What it raises
/// passes through to whoever evaluates the field. \param gradient None, or g(points) → array of shape (n, 3), in value
/// per world unit; without it gradients are central differences.
[[nodiscard]] FieldPtr callableField(const pybind11::object& f, const pybind11::object& gradient,
                                     std::optional<double> lipschitz);

}  // namespace pdc::python
