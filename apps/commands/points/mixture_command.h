#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "commands/points/point_options.h"

namespace pdc {

/// What the command line of `pdc mixture` says.
struct MixtureCommandRequest {
  std::filesystem::path input, output, json;
  MixtureRequest mixture;
  std::optional<int> threads;
  bool ascii = false, quiet = false;
};

void addMixtureCommandOptions(CLI::App& command, MixtureCommandRequest& request);

/// Reads points and writes the Gaussians of a mixture. \throws Error, Cancelled, CLI::ValidationError.
void runMixture(const MixtureCommandRequest& request);

}  // namespace pdc
