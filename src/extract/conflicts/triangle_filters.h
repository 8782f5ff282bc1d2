#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "extract/conflicts/float4_box.h"
#include "mesh/triangle_pair.h"

namespace pdc::detail {

// Quick tests that tell most pairs of triangles apart before the exact test.

/// On which sides of a plane some points are.
struct Sides {
  std::uint8_t bits;  ///< 1: above, where orient3d is 1; 2: under; 4: not known.

  friend Sides operator|(Sides a, Sides b) { return {static_cast<std::uint8_t>(a.bits | b.bits)}; }
  friend Sides operator&(Sides a, std::uint8_t mask) { return {static_cast<std::uint8_t>(a.bits & mask)}; }
  /// Whether all are on one side for certain.
  [[nodiscard]] bool same() const { return bits == 1 || bits == 2; }
  /// The side of a single point, as orient3d gives it; 0 if it is not known, or there is no point.
  [[nodiscard]] int sign() const { return (bits & 1) - (bits >> 1 & 1); }
};

inline Sides all(const std::array<Sides, 4>& s) { return s[0] | s[1] | s[2] | s[3]; }
inline Sides all(const std::array<Sides, 3>& s) { return s[0] | s[1] | s[2]; }
/// The signs of the first three.
template <std::size_t n>
TriangleSides::Signs signs(const std::array<Sides, n>& s) {
  return {s[0].sign(), s[1].sign(), s[2].sign()};
}

/// Several times what rounding can do to the sign of a triple product, relative to its factors.
inline constexpr double kSideRounding = 1e-14;

/// Four points, such as the corners of a quad, or of a triangle with the last one twice; in double precision, which
/// holds them exactly.
struct Points {
  std::array<double, 4> x, y, z;

  template <std::size_t n>
  explicit Points(const std::array<Vec3f, n>& p)
      : x{double{p[0].x}, double{p[1].x}, double{p[2].x}, double{p[n - 1].x}},
        y{double{p[0].y}, double{p[1].y}, double{p[2].y}, double{p[n - 1].y}},
        z{double{p[0].z}, double{p[1].z}, double{p[2].z}, double{p[n - 1].z}} {}
  Points() = default;

  /// Whether all points but the excepted ones lie above a plane for certain.
  template <typename Int4>
  [[nodiscard]] bool allAbove(const Vec3d& origin, const Vec3d& normal, const Int4& except) const {
    using Double4 = double __attribute__((vector_size(32)));
    using Long4 = long long __attribute__((vector_size(32)));
    Double4 dx, dy, dz;
    std::memcpy(&dx, x.data(), sizeof dx);
    std::memcpy(&dy, y.data(), sizeof dy);
    std::memcpy(&dz, z.data(), sizeof dz);
    dx -= origin.x;
    dy -= origin.y;
    dz -= origin.z;
    const Double4 side = dx * normal.x + dy * normal.y + dz * normal.z;
    const double bound = kSideRounding * kSideRounding * dot(normal, normal);
    const Long4 sure = (side > 0.0) & (side * side > (dx * dx + dy * dy + dz * dz) * bound);
    const Long4 held = sure | __builtin_convertvector(except, Long4);
    return (held[0] & held[1] & held[2] & held[3]) != 0;
  }
};
inline Quad quadOf(const Triangle& t) { return {t[0], t[1], t[2], t[2]}; }

/// The plane of a triangle, for a quick test of what lies to one side of it.
class TrianglePlane {
 public:
  TrianglePlane(const Triangle& vertices, const TriangleCorners& corners)
      : mVertices(vertices), mOrigin(vecCast<double>(corners[0])) {
    const Vec3d u = vecCast<double>(corners[1]) - mOrigin, v = vecCast<double>(corners[2]) - mOrigin;
    mNormal = cross(u, v);
    mErrorBound = kSideRounding * kSideRounding * dot(u, u) * dot(v, v);
  }

  /// The sides of some points.
  [[nodiscard]] std::array<Sides, 4> sides(const Points& points) const { return packed(sideBits(points)); }
  /// The sides of the corners of another face; none of those that are own corners too.
  [[nodiscard]] std::array<Sides, 4> sides(const Quad& vertices, const Points& corners) const {
    Int4 v;
    std::memcpy(&v, vertices.data(), sizeof v);
    const auto own = [&](int i) { return v == static_cast<std::int32_t>(mVertices[i]); };
    return packed(sideBits(corners) & ~(own(0) | own(1) | own(2)));
  }

 private:
  using Double4 = double __attribute__((vector_size(32)));
  using Int4 = std::int32_t __attribute__((vector_size(16)));

  /// The bits of Sides, as far as they are certain.
  [[nodiscard]] Int4 sideBits(const Points& points) const {
    Double4 x, y, z;
    std::memcpy(&x, points.x.data(), sizeof x);
    std::memcpy(&y, points.y.data(), sizeof y);
    std::memcpy(&z, points.z.data(), sizeof z);
    x -= mOrigin.x;
    y -= mOrigin.y;
    z -= mOrigin.z;
    const Double4 side = x * mNormal.x + y * mNormal.y + z * mNormal.z;
    const auto sure = side * side > (x * x + y * y + z * z) * mErrorBound;
    // Each bit is in the lower half of its number, where AVX2 has no other way to narrow it.
    using Int8 = std::int32_t __attribute__((vector_size(32)));
    const auto bits = reinterpret_cast<Int8>((sure & (side > 0.0) & 1) | (sure & (side < 0.0) & 2) | (~sure & 4));
    return __builtin_shufflevector(bits, bits, 0, 2, 4, 6);
  }
  [[nodiscard]] static std::array<Sides, 4> packed(Int4 bits) {
    using Byte16 = std::uint8_t __attribute__((vector_size(16)));
    const auto bytes = reinterpret_cast<Byte16>(bits);
    const auto low = __builtin_shufflevector(bytes, bytes, 0, 4, 8, 12);
    std::array<Sides, 4> sides;
    static_assert(sizeof low == sizeof sides);
    std::memcpy(&sides, &low, sizeof sides);
    return sides;
  }

  Triangle mVertices;
  Vec3d mOrigin, mNormal;
  double mErrorBound;
};

/// A quad with its corners and their mean.
struct FilteredQuad {
  FilteredQuad() = default;
  FilteredQuad(const Quad& v, const std::array<Vec3f, 4>& c) : vertices(v), corners(c), points(c) {
    center = (vecCast<double>(c[0]) + vecCast<double>(c[1]) + vecCast<double>(c[2]) + vecCast<double>(c[3])) * 0.25;
  }

  Quad vertices;
  std::array<Vec3f, 4> corners;
  Points points;
  Vec3d center;
};

/// Whether a plane through the one or two vertices that two quads share has all else of them strictly on its two sides:
/// then their triangles meet in what they share only. Tries the plane across the line between their centres, turned to
/// hold the shared edge.
[[nodiscard]] inline bool areParted(const FilteredQuad& a, const FilteredQuad& b) {
  using Int4 = std::int32_t __attribute__((vector_size(16)));
  Int4 av, bv, aShared{}, bShared{};
  std::memcpy(&av, a.vertices.data(), sizeof av);
  std::memcpy(&bv, b.vertices.data(), sizeof bv);
  for (int i = 0; i < 4; ++i) {
    aShared |= av == static_cast<std::int32_t>(b.vertices[i]);
    bShared |= bv == static_cast<std::int32_t>(a.vertices[i]);
  }
  std::array<int, 4> shared;
  int count = 0;
  for (int i = 0; i < 4; ++i)
    if (aShared[i] != 0) shared[count++] = i;
  if (count == 0 || count > 2) return false;
  const Vec3d origin = vecCast<double>(a.corners[shared[0]]);
  Vec3d normal = a.center - b.center;
  if (count == 2) {
    const Vec3d edge = vecCast<double>(a.corners[shared[1]]) - origin;
    normal -= edge * (dot(normal, edge) / dot(edge, edge));
  }
  return a.points.allAbove(origin, normal, aShared) && b.points.allAbove(origin, -normal, bShared);
}

/// A triangle of a mesh with what the quick tests need to know of it.
struct FilteredTriangle {
  FilteredTriangle(const Triangle& v, const TriangleCorners& c)
      : vertices(v), corners(c), points(c), plane(v, c), box(c) {}

  Triangle vertices;
  TriangleCorners corners;
  Points points;
  TrianglePlane plane;
  Float4Box box;
};

/// Does what trianglesIntersect() does for plain triangles.
[[nodiscard]] inline bool trianglesIntersect(const FilteredTriangle& a, const FilteredTriangle& b) {
  if (a.box.apartFrom(b.box)) return false;
  const std::array<Sides, 4> bSides = a.plane.sides(quadOf(b.vertices), b.points);
  if (all(bSides).same()) return false;
  const std::array<Sides, 4> aSides = b.plane.sides(quadOf(a.vertices), a.points);
  if (all(aSides).same()) return false;
  return trianglesIntersect(a.corners, a.vertices, b.corners, b.vertices, {signs(aSides), signs(bSides)});
}

}  // namespace pdc::detail
