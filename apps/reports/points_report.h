#pragma once

#include <nlohmann/json.hpp>

#include "pdc/points/reconstruct.h"

namespace pdc {

[[nodiscard]] nlohmann::ordered_json toJson(const MixtureReport& report);

/// What made a surface of points, without the times.
[[nodiscard]] nlohmann::ordered_json toJson(const ReconstructReport& report);

}  // namespace pdc
