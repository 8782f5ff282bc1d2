#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "pdc/smooth/smooth.h"

namespace pdc {

/// What the command line of `pdc smooth` says.
struct SmoothRequest {
  std::filesystem::path input, output, json;
  SmoothOptions options;
  std::optional<int> iterations, threads;
  bool ascii = false, quiet = false;
};

void addSmoothOptions(CLI::App& command, SmoothRequest& request);

/// Reads a mesh and writes it without noise. \throws Error, Cancelled, CLI::ValidationError.
void runSmooth(const SmoothRequest& request);

}  // namespace pdc
