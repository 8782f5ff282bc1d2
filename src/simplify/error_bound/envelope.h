#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/nearest_triangles.h"
#include "mesh/point_triangle.h"

namespace pdc::detail {

/// The points within some distance of a surface (Cohen et al. 1996 call it the simplification envelope). Several
/// threads may ask at a time.
class Envelope {
 public:
  static constexpr std::uint32_t kNone = NearestTriangle::kNone;

  /// \param surface has triangles only, has passed checkIndices() and has to live as long, unchanged.
  /// \param distance more than 0, in its units.
  Envelope(const Mesh& surface, double distance);

  [[nodiscard]] double distance() const { return mDistance; }

  /// The surface's triangle nearest to a point, kNone if it is outside. \param guess one that may be near, or kNone.
  [[nodiscard]] std::uint32_t nearest(const Vec3d& p, std::uint32_t guess) const;

  /// Whether all points of a triangle are inside; see Coverage. \param near a triangle of the surface near to it, or
  /// kNone; only saves time. \param used gets the triangles of the surface that it is near to, as far as they are
  /// needed, if it is inside.
  bool contains(const TrianglePoints& triangle, std::uint32_t near, std::vector<std::uint32_t>* used = nullptr) const {
    return contains(triangle, near, used, mDistance);
  }
  /// Whether all points of a triangle are within a smaller distance than the envelope's own.
  bool contains(const TrianglePoints& triangle, std::uint32_t near, std::vector<std::uint32_t>* used,
                double distance) const;

 private:
  class Walk;

  [[nodiscard]] NearestTriangle findNear(const Vec3d& p, std::uint32_t guess) const;

  const Mesh& mSurface;
  const double mDistance;
  NearestTriangles mNearest;
  std::vector<std::array<std::uint32_t, 3>> mBeyond;  ///< By triangle, that across the edge after each corner.
};

/// The corners of a mesh's triangle.
[[nodiscard]] inline TrianglePoints trianglePoints(const Buffer<Vec3f>& positions, const Triangle& t) {
  return {vecCast<double>(positions[t[0]]), vecCast<double>(positions[t[1]]), vecCast<double>(positions[t[2]])};
}

}  // namespace pdc::detail
