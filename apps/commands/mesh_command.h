#pragma once

#include "requests/mesh_request.h"

namespace pdc {

/// Reads, contours, writes and reports. Warnings go to standard error, the summary to standard output.
/// \throws Error, CLI::ValidationError (see checkMeshRequest), Cancelled; no output file exists then.
void runMesh(const MeshRequest& request);

}  // namespace pdc
