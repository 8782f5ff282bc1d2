#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>

#include "pdc/io/volume/volume_reader.h"

namespace pdc {

/// What the command line of `pdc info` says.
struct InfoRequest {
  std::filesystem::path file, json;
  std::filesystem::path histogram;  ///< A picture of a volume's values; empty for none.
  VolumeReadOptions volume;
  bool quiet = false;
  std::filesystem::path reference;   ///< A mesh to compare with; empty for none.
  std::int64_t samples = 1'000'000;  ///< On each of the two surfaces.
};

void addInfoOptions(CLI::App& command, InfoRequest& request);

/// Prints what is in the file, and on request how far the mesh in it is from another, as aligned text or, on request,
/// as JSON. \throws Error.
void runInfo(const InfoRequest& request);

}  // namespace pdc
