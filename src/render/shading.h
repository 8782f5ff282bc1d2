#pragma once

#include "pdc/math/vec3.h"
#include "pdc/render/render.h"

namespace pdc::detail {

/// Colours are linear light, 0 to 1. Normals are in view space and face the viewer (z > 0 or nearly).

[[nodiscard]] Vec3f backgroundColor();
/// The colour of kValues for a `share` of the range, from 0 to 1; beyond these the colour of the nearer end, for NaN
/// grey.
[[nodiscard]] Vec3f valueColor(float share);
/// The colour of a point of the surface. \param share the value's place in the range, for kValues. \param open the
/// share of the sky that the point sees.
[[nodiscard]] Vec3f surfaceColor(Shading shading, const Vec3f& normal, float share, bool backFace, float open);
/// The sRGB byte of linear light, with the power 1/2 for sRGB's curve.
[[nodiscard]] std::uint8_t toByte(float linear);

}  // namespace pdc::detail
