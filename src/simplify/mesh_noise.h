#pragma once

#include <vector>

#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// meshNoise() of a surface whose stars are known; of NaN among the positions it looks away.
[[nodiscard]] double meshNoise(const VertexStars& stars, const std::vector<Vec3d>& positions);

}  // namespace pdc::detail
