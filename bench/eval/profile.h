#pragma once

#include <vector>

#include "eval/shapes.h"

namespace pdc::eval {

struct Point2 {
  double x, y;
};

/// A plane figure that its outline surrounds once, seen from the origin: a disc or a polygon, perhaps with a round
/// hole.
struct Profile {
  std::vector<Point2> polygon{};  ///< Counter-clockwise; empty for a disc.
  double radius = 0;              ///< Radius of the disc.
  double hole = 0;                ///< Radius of the hole; 0 without one.

  [[nodiscard]] double distance(double x, double y) const;
  /// Distance from the origin to the outline in the direction of an angle.
  [[nodiscard]] double outline(double angle) const;
  /// Angles for a fine mesh, those of the polygon's corners among them.
  [[nodiscard]] std::vector<double> angles() const;
};

/// The profile from z = -halfHeight to halfHeight.
[[nodiscard]] Shape extrude(std::string name, bool heldOut, const Profile& profile, double halfHeight);

/// A polygon in the (r, z) plane, symmetric about r = 0, turned about the z axis.
[[nodiscard]] Shape revolve(std::string name, bool heldOut, const std::vector<Point2>& polygon);

}  // namespace pdc::eval
