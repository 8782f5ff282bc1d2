#pragma once

#include "pdc/mesh/vertex_property.h"

namespace pdc::detail {

/// The property's numbers, or its vectors' lengths: one per vertex, rounded to single precision.
[[nodiscard]] Buffer<float> magnitudes(const VertexProperty& property);

}  // namespace pdc::detail
