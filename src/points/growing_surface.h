#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pdc/math/vec3.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Triangles over given points, of which more and more are put together. No edge has more than two, and all are turned
/// the same way; several fans may meet at a vertex.
class GrowingSurface {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A triangle (v, to, third), seen from its corner v.
  struct Corner {
    std::uint32_t to, third;
  };

  explicit GrowingSurface(std::span<const Vec3d> places)
      : mPlaces(places), mCorners(places.size()), mOpen(places.size()) {}

  /// Whether no edge of it has two triangles or one that is turned the other way.
  [[nodiscard]] bool accepts(const Triangle& t) const {
    return across(t[0], t[1]) == kNone && across(t[1], t[2]) == kNone && across(t[2], t[0]) == kNone;
  }
  /// \param t is accepted.
  void add(const Triangle& t);

  /// The third corner of the triangle that has the edge from a to b, in this direction; kNone if there is none.
  [[nodiscard]] std::uint32_t across(std::uint32_t a, std::uint32_t b) const {
    for (const Corner& corner : mCorners[a])
      if (corner.to == b) return corner.third;
    return kNone;
  }
  [[nodiscard]] bool isUsed(std::uint32_t v) const { return !mCorners[v].empty(); }
  /// Whether triangles are all around it.
  [[nodiscard]] bool isInside(std::uint32_t v) const { return isUsed(v) && mOpen[v] == 0; }
  /// Whether a triangle has the edge from a to b, and none that from b to a.
  [[nodiscard]] bool isFront(std::uint32_t a, std::uint32_t b) const {
    return across(a, b) != kNone && across(b, a) == kNone;
  }

  [[nodiscard]] std::span<const Corner> corners(std::uint32_t v) const { return mCorners[v]; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return mTriangles; }
  [[nodiscard]] const Vec3d& place(std::uint32_t v) const { return mPlaces[v]; }
  /// Not of unit length.
  [[nodiscard]] Vec3d normal(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return cross(mPlaces[b] - mPlaces[a], mPlaces[c] - mPlaces[a]);
  }

 private:
  std::span<const Vec3d> mPlaces;
  std::vector<std::vector<Corner>> mCorners;
  std::vector<std::uint32_t> mOpen;  ///< How many edges on the front begin at each vertex.
  std::vector<Triangle> mTriangles;
};

/// Whether two triangles that face about the same way, or about opposite ways, cover each other by more than a seventh
/// of their size where one is seen along the other's normal, and lie no farther apart there than `height`.
[[nodiscard]] bool coverEachOther(std::span<const Vec3d, 3> a, std::span<const Vec3d, 3> b, double height);

}  // namespace pdc::detail
