#pragma once

#include <array>
#include <span>

#include "mesh/triangle_pair.h"
#include "pdc/math/box.h"
#include "pdc/math/vec3.h"

namespace pdc::detail {

/// A box whose edges have any directions: center + the sum of axes[k] · t for |t| <= half[k].
struct OrientedBox {
  using Axes = std::array<Vec3d, 3>;

  Vec3d center{};
  Axes axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< Unit vectors at right angles.
  Vec3d half{};

  OrientedBox() = default;
  explicit OrientedBox(const BoxF& box);
  /// The box with these axes around points. It is larger by what rounding may hide, and by `margin`.
  OrientedBox(const Axes& axes, std::span<const Vec3d> points, double margin);

  [[nodiscard]] std::array<Vec3d, 8> corners() const;
  [[nodiscard]] double surface() const;
  /// Whether a plane at right angles to an axis of either separates the two. If not they may be apart nonetheless.
  [[nodiscard]] bool apartFrom(const OrientedBox& o) const;
};

/// Axes along the longest edge of a triangle, in its plane, and along its normal.
[[nodiscard]] OrientedBox::Axes axesAlong(const TriangleCorners& t);

/// Whether a triangle's longest edge is more than 16 times its height, so that axis-aligned boxes fit it badly.
[[nodiscard]] bool isSliver(const TriangleCorners& t);

}  // namespace pdc::detail
