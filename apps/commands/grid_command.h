#pragma once

#include <CLI/CLI.hpp>

#include "requests/mesh_request.h"

namespace pdc {

/// Declares the options of `pdc grid`, which are some of those of `pdc mesh`.
void addGridOptions(CLI::App& command, MeshRequest& request);

/// Reads a grid, takes the steps and writes what comes out. \throws Error, Cancelled, CLI::ValidationError.
void runGrid(const MeshRequest& request);

}  // namespace pdc
