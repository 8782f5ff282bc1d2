#include <pybind11/stl.h>

#include <utility>

#include "convert.h"
#include "groups/groups.h"
#include "inputs/contour_run.h"
#include "inputs/open_source.h"
#include "inputs/request.h"
#include "polite_run.h"

namespace pdc::python {
namespace {

/// The mesh and the report of `pdc mesh --json` on it, as far as it is not about files.
std::pair<MeshHandle, py::object> contourSource(const py::tuple& source, const py::dict& options,
                                                const py::object& progress) {
  MeshRequest request = requestOf(options);
  const OpenInput open = withGrids(openSource(source, request), GivenOptions(options));
  ContourRun made =
      makePolitely(progress, [&](const Monitor& monitor) { return contourInput(open, request, monitor); });
  nlohmann::ordered_json report = toJson(request, made.run);
  for (const char* key : {"output", "bytes_written", "double_precision"}) report.erase(key);
  report["seconds"].erase("write");
  return {MeshHandle(std::move(made.mesh)), toPython(report)};
}

}  // namespace

void addContour(py::module_& module) { module.def("contour", &contourSource); }

}  // namespace pdc::python
