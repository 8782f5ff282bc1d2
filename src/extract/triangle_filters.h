#pragma once

#include <array>

#include "math/float4.h"
#include "mesh/triangle_pair.h"

namespace pdc::detail {

// Quick looks that tell most pairs of triangles apart before the exact test.

/// The plane of a triangle, for a quick look at what lies to one side of it.
class TrianglePlane {
 public:
  TrianglePlane(const Triangle& vertices, const TriangleCorners& corners)
      : mVertices(vertices), mOrigin(vecCast<double>(corners[0])) {
    const Vec3d u = vecCast<double>(corners[1]) - mOrigin, v = vecCast<double>(corners[2]) - mOrigin;
    mNormal = cross(u, v);
    // Several times what rounding can do to the sign of a triple product.
    constexpr double kRounding = 1e-14;
    mDoubt = kRounding * kRounding * dot(u, u) * dot(v, v);
  }

  /// True if other triangles, with these corners, meet this one in no more than a vertex or an edge that they share:
  /// all corners that are not its own are strictly on one side. False says nothing.
  template <std::size_t n>
  [[nodiscard]] bool clears(const std::array<std::uint32_t, n>& vertices, const std::array<Vec3f, n>& corners) const {
    int above = 0, under = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t v = vertices[i];
      if (v == mVertices[0] || v == mVertices[1] || v == mVertices[2]) continue;
      const Vec3d w = vecCast<double>(corners[i]) - mOrigin;
      const double side = dot(w, mNormal);
      if (!(side * side > mDoubt * dot(w, w))) return false;
      ++(side > 0 ? above : under);
    }
    return (above == 0) != (under == 0);
  }

 private:
  Triangle mVertices;
  Vec3d mOrigin, mNormal;
  double mDoubt;
};

/// A box in world space.
struct Box {
  Float4 low, high;

  template <std::size_t n>
  explicit Box(const std::array<Vec3f, n>& corners) : low(float4(corners[0])), high(low) {
    for (std::size_t i = 1; i < n; ++i) add(float4(corners[i]));
  }
  void add(Float4 p) {
    low = p < low ? p : low;
    high = p > high ? p : high;
  }
  [[nodiscard]] bool apartFrom(const Box& b) const {
    const auto gap = (low > b.high) | (b.low > high);
    return (gap[0] | gap[1] | gap[2]) != 0;
  }
};

}  // namespace pdc::detail
