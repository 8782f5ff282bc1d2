#pragma once

#include <functional>

#include "pdc/io/open_input.h"
#include "pdc/monitor.h"
#include "reports/json_report.h"
#include "requests/mesh_request.h"

namespace pdc::python {

/// Makes an input ready; called without the interpreter's lock.
using OpenInput = std::function<Input(const Monitor&)>;

/// A mesh, and what its report says.
struct ContourRun {
  Mesh mesh;
  MeshRun run;
};

/// What `pdc mesh` does between reading and writing. Called without the interpreter's lock.
[[nodiscard]] ContourRun contourInput(const OpenInput& open, const MeshRequest& request, const Monitor& monitor);

}  // namespace pdc::python
