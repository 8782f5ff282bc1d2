#pragma once

#include "pdc/math/vec3.h"
#include "pdc/render/render.h"

namespace pdc::detail {

/// Colours are linear light, 0 to 1. Normals are in view space and face the viewer (z > 0 or nearly).

[[nodiscard]] Vec3f backgroundColor();
/// The colour of kValues for `share` from 0 to 1; values beyond them take the ends'. NaN is grey.
[[nodiscard]] Vec3f valueColor(float share);
/// \param share for kValues. \param open share of the sky that the point sees.
[[nodiscard]] Vec3f surfaceColor(Shading shading, const Vec3f& normal, float share, bool backFace, float open);
/// Converts to an sRGB byte, with the power 1/2 for sRGB's curve.
[[nodiscard]] std::uint8_t toByte(float linear);

}  // namespace pdc::detail
