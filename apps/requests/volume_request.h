#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pdc/io/volume/volume_reader.h"

namespace pdc {

/// Declares --raw, --array, --volume-index, --channel, --spacing and --space; they are stored when the line is parsed.
void addVolumeOptions(CLI::App& command, VolumeReadOptions& volume, const std::string& group);

/// \throws CLI::ValidationError if one of them was given, for an input that is no volume.
void refuseVolumeOptions(const VolumeReadOptions& volume);

}  // namespace pdc
