#include <openvdb/openvdb.h>
#include <pybind11/pybind11.h>

#include "groups/groups.h"
#include "pdc/error.h"
#include "remedies.h"

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  module.doc() = "What the package pdc is made of; not for direct use.";
  module.attr("version") = PDC_VERSION;
  openvdb::initialize();
  // Lives as long as the interpreter, which may be gone when statics end.
  static const auto* const kError = new py::exception<pdc::Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const pdc::Cancelled&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    } catch (const pdc::Error& e) {
      PyErr_SetString(kError->ptr(), pdc::python::inPythonsWords(e.what()).c_str());
    }
  });
  pdc::python::addMesh(module);
  pdc::python::addFields(module);
  pdc::python::addGrids(module);
  pdc::python::addGridSteps(module);
  pdc::python::addVolumes(module);
  pdc::python::addContour(module);
  pdc::python::addVerbs(module);
  pdc::python::addPoints(module);
  pdc::python::addFacts(module);
  pdc::python::addRender(module);
  pdc::python::addSweep(module);
}
