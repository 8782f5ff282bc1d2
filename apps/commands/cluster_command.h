#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "pdc/simplify/cluster.h"

namespace pdc {

/// What the command line of `pdc cluster` says.
struct ClusterRequest {
  std::filesystem::path input, output, json;
  ClusterOptions options;
  std::optional<double> cell, sigmaNormal, sigmaPosition;
  std::optional<int> threads;
  bool ascii = false, quiet = false;
};

void addClusterOptions(CLI::App& command, ClusterRequest& request);

/// Reads a mesh, in pieces where the file allows that, and writes one vertex for each cell that it meets.
/// \throws Error, Cancelled, CLI::ValidationError.
void runCluster(const ClusterRequest& request);

}  // namespace pdc
