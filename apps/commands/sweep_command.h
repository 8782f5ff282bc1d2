#pragma once

#include <string>

#include "requests/sweep_request.h"

namespace pdc {

/// Contours an input for several values and writes sweep.csv, sweep.json, index.html and, on request, the meshes.
/// \param command what the page says that it was made by. \throws Error, CLI::ValidationError, Cancelled.
void runSweep(SweepRequest request, const std::string& command);

}  // namespace pdc
