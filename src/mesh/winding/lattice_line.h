#pragma once

#include <array>

#include "pdc/math/predicates.h"

/// Where points and lines along an axis lie beside triangles, decided exactly and never undecided: points count as
/// moved by (e, e², e³) for an e above 0 that is smaller than all else (Edelsbrunner & Mücke 1990, Simulation of
/// Simplicity). So a line that meets an edge or a vertex of a closed surface passes through one of the triangles there,
/// not through none or two. Coordinates as the predicates take them.
namespace pdc::detail {

inline int signOf(double v) { return (v > 0 ? 1 : 0) - (v < 0 ? 1 : 0); }

/// Which way a, b and the line through p along an axis turn, seen from the axis's positive end; 0 if a and b are one
/// point there.
[[nodiscard]] inline int turnAbout(const Vec3d& p, int axis, const Vec3d& a, const Vec3d& b) {
  if (const int turn = orient2d(a, b, p, axis); turn != 0) return turn;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int alongU = signOf(b[u] - a[u]), alongV = signOf(b[v] - a[v]);
  // The axis of the lower number is that of the larger move.
  if (u < v) return alongV != 0 ? -alongV : alongU;
  return alongU != 0 ? alongU : -alongV;
}

/// Whether the line through p along an axis passes through a triangle: the sign of the triangle's normal along the
/// axis, or 0 if it passes by.
[[nodiscard]] inline int passThrough(const Vec3d& p, int axis, const std::array<Vec3d, 3>& t) {
  const int turn = turnAbout(p, axis, t[0], t[1]);
  return turn != 0 && turn == turnAbout(p, axis, t[1], t[2]) && turn == turnAbout(p, axis, t[2], t[0]) ? turn : 0;
}

/// On which side of a triangle's plane p is: 1 where the triangle is counter-clockwise, else -1; 0 if it has no area.
[[nodiscard]] inline int sideOfPlane(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  int side = orient3d(t[0], t[1], t[2], p);
  for (int axis = 0; axis < 3 && side == 0; ++axis) side = orient2d(t[0], t[1], t[2], axis);
  return side;
}

}  // namespace pdc::detail
