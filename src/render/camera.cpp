#include "pdc/render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "pdc/error.h"

namespace pdc {
namespace {

/// Share of the picture's width and height that stays free at each border.
constexpr double kMargin = 0.04;

Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

Mat3d axesOf(const Vec3d& towardsViewer) {
  constexpr double kAlongZ = 1e-6;
  const Vec3d back = unit(towardsViewer);
  const Vec3d above = std::hypot(back.x, back.y) > kAlongZ ? Vec3d{0, 0, 1} : Vec3d{0, back.z, 0};
  const Vec3d right = unit(cross(above, back));
  return {{right, cross(back, right), back}};
}

/// Grows lo and hi to hold the mesh's faces, moved by an offset, seen along the axes.
void include(const Mesh& mesh, const Vec3d& offset, const Mat3d& axes, Vec3d& lo, Vec3d& hi) {
  for (std::size_t i = 0; i < detail::triangleCount(mesh); ++i) {
    const auto corners = detail::corners(mesh, detail::triangle(mesh, i));
    if (!std::all_of(corners.begin(), corners.end(), detail::isFinite)) continue;
    for (const Vec3f& corner : corners) {
      const Vec3d p = axes * (offset + vecCast<double>(corner));
      for (int k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], p[k]);
        hi[k] = std::max(hi[k], p[k]);
      }
    }
  }
}

}  // namespace

std::optional<Vec3d> viewNamed(std::string_view name) {
  if (name == "iso") return Vec3d{1, -1, 1};
  if (name == "front") return Vec3d{0, -1, 0};
  if (name == "back") return Vec3d{0, 1, 0};
  if (name == "left") return Vec3d{-1, 0, 0};
  if (name == "right") return Vec3d{1, 0, 0};
  if (name == "top") return Vec3d{0, 0, 1};
  if (name == "bottom") return Vec3d{0, 0, -1};
  return std::nullopt;
}

Camera fitCamera(std::span<const Mesh> meshes, const Vec3d& towardsViewer, int width, int height) {
  const double l = length(towardsViewer);
  if (!(l > 0) || !std::isfinite(l)) throw std::invalid_argument("fitCamera: the viewer's direction is no direction");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Mat3d axes = axesOf(towardsViewer);
  // Relative to one of the meshes, so that sums stay small.
  const Vec3d origin = meshes.empty() ? Vec3d{} : meshes.front().origin;
  Vec3d lo{kInfinity, kInfinity, kInfinity}, hi = -lo;
  for (const Mesh& mesh : meshes) {
    detail::checkSizes(mesh, "fitCamera");
    detail::checkIndices(mesh);
    include(mesh, mesh.origin - origin, axes, lo, hi);
  }
  if (!(lo.x <= hi.x)) throw Error("nothing to show: the mesh has no face with finite corners");
  const Vec3d size = hi - lo;
  const double free = 1 - 2 * kMargin;
  // A mesh that is one point looks the same at any scale.
  const double scale = std::min(free * width / size.x, free * height / size.y);
  return {axes, origin + axes.transposed() * ((lo + hi) * 0.5), std::isfinite(scale) ? scale : 1};
}

}  // namespace pdc
