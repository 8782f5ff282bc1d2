#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "pdc/simplify/decimate.h"

namespace pdc {

/// What the command line of `pdc decimate` says.
struct DecimateRequest {
  std::filesystem::path input, output, json;
  DecimateOptions options;
  std::optional<int> faces, threads;
  std::optional<double> maxTurn, boundaryWeight;
  bool noFit = false, ascii = false, quiet = false;
};

void addDecimateOptions(CLI::App& command, DecimateRequest& request);

/// Reads a mesh and writes one of fewer triangles. \throws Error, Cancelled, CLI::ValidationError.
void runDecimate(const DecimateRequest& request);

}  // namespace pdc
