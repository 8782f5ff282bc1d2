#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace pdc {

/// What the command line of `pdc info` says.
struct InfoRequest {
  std::filesystem::path file, json;
  bool quiet = false;
};

void addInfoOptions(CLI::App& command, InfoRequest& request);

/// Prints what is in the file, as aligned text or, on request, as JSON. \throws Error.
void runInfo(const InfoRequest& request);

}  // namespace pdc
