#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "pdc/math/mat3.h"
#include "pdc/mesh/mesh.h"

namespace pdc {

/// Where the viewer of a named view stands: the direction to there from the mesh. z is up: "front" looks along +y,
/// "right" along -x, "top" along -z; "iso" comes from the corner (1, -1, 1). Empty for other names than iso, front,
/// back, left, right, top and bottom.
[[nodiscard]] std::optional<Vec3d> viewNamed(std::string_view name);

/// A parallel projection: a point p of the world is at `axes` (p - center) · pixelsPerUnit pixels from the middle of
/// the picture: right, up, and towards the viewer. `axes` is a rotation and pixelsPerUnit > 0; neither is checked.
struct Camera {
  Mat3d axes;
  Vec3d center{};
  double pixelsPerUnit = 1;
};

/// The camera that shows all faces of all meshes as large as they go into a picture of this size, with a margin of four
/// hundredths of it; z points up in the picture, or y where the viewer looks along z. width, height > 0 in pixels.
/// \throws Error if no face has finite corners or one names a vertex that does not exist; std::invalid_argument for a
/// direction that is zero or not finite.
[[nodiscard]] Camera fitCamera(std::span<const Mesh> meshes, const Vec3d& towardsViewer, int width, int height);

}  // namespace pdc
