#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "convert.h"
#include "groups/groups.h"
#include "polite_run.h"
#include "reports/check_facts.h"
#include "reports/info_facts.h"

namespace pdc::python {
namespace {

py::object check(const MeshHandle& mesh, bool allowBoundary, bool allowEmpty, int threads, const py::object& progress) {
  nlohmann::ordered_json facts = makePolitely(progress, threads, [&](const Monitor& monitor) {
    return checkFacts(MeshFile{*mesh.mesh, {}}, monitor);
  });
  facts["faults"] = faultsIn(facts, {.boundary = allowBoundary, .empty = allowEmpty});
  facts["clean"] = facts["faults"].empty();
  facts.erase("warnings");
  return toPython(facts);
}

py::object info(const std::filesystem::path& path) {
  return toPython(makePolitely(py::none(), [&](const Monitor&) { return gatherFacts(path); }));
}

}  // namespace

void addFacts(py::module_& module) {
  module.def("check", &check);
  module.def("info", &info);
}

}  // namespace pdc::python
