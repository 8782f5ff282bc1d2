#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "commands/points/point_options.h"
#include "pdc/points/reconstruct.h"

namespace pdc {

/// What the command line of `pdc reconstruct` says.
struct ReconstructRequest {
  std::filesystem::path input, output, covariances, json;
  MixtureRequest mixture;
  std::optional<double> leastOverlap, voxelSize;
  std::optional<int> subdivisions, threads;
  bool close = false, ascii = false, quiet = false;
};

void addReconstructOptions(CLI::App& command, ReconstructRequest& request);

/// Reads points and writes a surface. \throws Error, Cancelled, CLI::ValidationError.
void runReconstruct(const ReconstructRequest& request);

}  // namespace pdc
