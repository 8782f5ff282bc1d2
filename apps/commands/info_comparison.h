#pragma once

#include <nlohmann/json.hpp>

#include "commands/info_command.h"

namespace pdc {

/// What `pdc info` says about a mesh that is compared with a reference: its facts, and the figures under "reference".
/// Shows a progress bar and can be interrupted. \throws Error for files that are no meshes, for meshes without a face
/// that has an area, and for no samples; Cancelled.
[[nodiscard]] nlohmann::ordered_json compareFiles(const InfoRequest& request);

}  // namespace pdc
