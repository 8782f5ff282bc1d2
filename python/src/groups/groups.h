#pragma once

#include <pybind11/pybind11.h>

/// Each group of functions puts itself into the module `pdc._core`, whose users are the Python files beside it: they
/// check what callers give, and give it in the types named here.
namespace pdc::python {

namespace py = pybind11;

void addMesh(py::module_& module);
void addFields(py::module_& module);
void addGrids(py::module_& module);
void addGridSteps(py::module_& module);
void addVolumes(py::module_& module);
void addContour(py::module_& module);
void addVerbs(py::module_& module);
void addPoints(py::module_& module);
void addFacts(py::module_& module);
void addRender(py::module_& module);
void addSweep(py::module_& module);

}  // namespace pdc::python
