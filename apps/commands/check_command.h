#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

namespace pdc {

/// What the command line of `pdc check` says.
struct CheckRequest {
  std::filesystem::path file, json;
  std::optional<int> threads;
  bool allowBoundary = false, allowEmpty = false, quiet = false;
};

void addCheckOptions(CLI::App& command, CheckRequest& request);

/// Prints what is wrong with a mesh, as aligned text with a verdict or, on request, as JSON. Returns whether the mesh
/// is clean. \throws Error, Cancelled.
[[nodiscard]] bool runCheck(const CheckRequest& request);

}  // namespace pdc
