#pragma once

#include <array>
#include <cstdint>

#include "extract/vertices/placed_quadrics.h"
#include "math/float_lanes.h"
#include "math/lane_loops.h"

namespace pdc::detail {

/// Sixteen quads about lattice edges, one per lane, their corners in the order of kCellsAboutEdge: at the axis' next
/// two axes (u, v) = (0, 0), (-1, 0), (-1, -1), (0, -1).
struct QuadLanes {
  alignas(64) std::uint32_t axis[kLanes];  ///< The axis of each edge.
  /// The members of each corner's PlacedQuadric, in order.
  alignas(64) float corner[4][12][kLanes];
  /// 1 for a diagonal from corner 0 to 2, 0 for one from 1 to 3.
  alignas(64) std::uint32_t first[kLanes];
  /// Bit 0: whether the quad passes between the ends of its lattice edge when it is split as `first` says; bit 1: when
  /// it is split the other way.
  alignas(64) std::uint32_t passes[kLanes];

  [[nodiscard]] PlacedQuadric get(int k, int lane) const {
    const auto& c = corner[k];
    return {{c[0][lane], c[1][lane], c[2][lane]},
            {c[3][lane], c[4][lane], c[5][lane], c[6][lane], c[7][lane], c[8][lane]},
            {c[9][lane], c[10][lane], c[11][lane]}};
  }
  /// Sets a corner of four lanes from `lane` on.
  void set(int k, int lane, const std::array<const PlacedQuadric*, 4>& quadrics) {
    static_assert(sizeof(PlacedQuadric) == sizeof corner[0] / kLanes);
    const auto from = [&quadrics](int i, int part) { return reinterpret_cast<const float*>(quadrics[i]) + part; };
    for (int part = 0; part < 12; part += 4)
      transpose4({from(0, part), from(1, part), from(2, part), from(3, part)}, &corner[k][part][lane], kLanes);
  }
};

/// The one of x, y and z that is the axis' own.
template <typename T>
constexpr T ofAxis(std::uint32_t axis, const T& x, const T& y, const T& z) {
  const T yz = axis == 1 ? y : z;
  return axis == 0 ? x : yz;
}
constexpr Vec3f ofAxis(std::uint32_t axis, const Vec3f& x, const Vec3f& y, const Vec3f& z) {
  return {ofAxis(axis, x.x, y.x, z.x), ofAxis(axis, x.y, y.y, z.y), ofAxis(axis, x.z, y.z, z.z)};
}

/// Chooses the diagonals: where the summed error of the four vertices, taken at the diagonal's middle, is not larger.
/// Must be compiled into a function of a SimdLevel.
///
/// About the edge's low end that sum is mᵀSm − 2hᵀm with S = ΣAₖ and h = Σ(Aₖrₖ + bₖ), where rₖ, a corner of a cube of
/// edge 1, is the centre of cell k. With s and t twice the middles, the quadrics differ by a quarter of
/// (s − t)ᵀ(S(s + t) − 4h). In 4h the rₖ turn into signs, and half along the axis, which all of them have and s + t has
/// four times, drops out: vertices may be taken from the centres of their cells.
inline void chooseDiagonals(QuadLanes& quads) {
  forEachLane([&quads](int i) {
    const PlacedQuadric e0 = quads.get(0, i), e1 = quads.get(1, i), e2 = quads.get(2, i), e3 = quads.get(3, i);
    const SymMat3<float> p = e0.A - e2.A, q = e1.A - e3.A, S = (e0.A + e2.A) + (e1.A + e3.A), u = p - q, v = p + q;
    const Vec3f x02 = e0.x + e2.x, x13 = e1.x + e3.x, b = (e0.b + e2.b) + (e1.b + e3.b);
    // The columns of the axes that follow the edge's.
    const Vec3f signs =
        ofAxis(quads.axis[i], Vec3f{u.xy, u.yy, u.yz} + Vec3f{v.xz, v.yz, v.zz},
               Vec3f{u.xz, u.yz, u.zz} + Vec3f{v.xx, v.xy, v.xz}, Vec3f{u.xx, u.xy, u.xz} + Vec3f{v.xy, v.yy, v.yz});
    const Vec3f h4 = b * 4.0F + signs * 2.0F;
    quads.first[i] = dot(x02 - x13, S * (x02 + x13) - h4) > 0 ? 0 : 1;
  });
}

/// Finds out whether the lattice edges pass from behind to before the planes of both triangles of a quad, for either
/// diagonal: a quick test that may say no in vain, but not yes. Must be compiled into a function of a SimdLevel.
/// \param errorBound what rounding may add to, or take from, the volumes that this looks at.
inline void findPassing(QuadLanes& quads, float errorBound) {
  forEachLane([&quads, errorBound](int i) {
    const std::uint32_t axis = quads.axis[i];
    const auto corner = [&quads, i](int k) {
      const auto& c = quads.corner[k];
      return Vec3f{c[0][i], c[1][i], c[2][i]} + Vec3f{0.5F, 0.5F, 0.5F};
    };
    const auto crosses = [errorBound, axis](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
      const Vec3f n = cross(b - a, c - a);
      const float low = dot(n, a), high = ofAxis(axis, n.x, n.y, n.z) - low;
      return unsigned(low > errorBound) & unsigned(high > errorBound);
    };
    const Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, u = ofAxis(axis, y, z, x), v = ofAxis(axis, z, x, y);
    const Vec3f p0 = corner(0), p1 = corner(1) - u, p2 = corner(2) - u - v, p3 = corner(3) - v;
    const unsigned first = crosses(p0, p1, p2) & crosses(p0, p2, p3);
    const unsigned second = crosses(p1, p2, p3) & crosses(p1, p3, p0);
    quads.passes[i] = quads.first[i] != 0 ? first | second << 1 : second | first << 1;
  });
}

}  // namespace pdc::detail
