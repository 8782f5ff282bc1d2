#include "extract/block_faces.h"

#include <bit>
#include <cstring>

#include "extract/cell_rounding.h"
#include "extract/cell_vertices.h"
#include "extract/float_lanes.h"
#include "extract/quad_rings.h"
#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

/// A VertexError, or a sum of some, in three registers.
struct PackedError {
  explicit PackedError(const VertexError& e) {
    static_assert(sizeof e == 12 * sizeof(float));
    const auto* p = reinterpret_cast<const float*>(&e);
    v[0] = loadFloat4(p), v[1] = loadFloat4(p + 4), v[2] = loadFloat4(p + 8);
  }
  friend PackedError operator+(PackedError a, const PackedError& b) {
    for (int i = 0; i < 3; ++i) a.v[i] += b.v[i];
    return a;
  }
  friend PackedError operator-(PackedError a, const PackedError& b) {
    for (int i = 0; i < 3; ++i) a.v[i] -= b.v[i];
    return a;
  }

  [[nodiscard]] Vec3f x() const { return {v[0][0], v[0][1], v[0][2]}; }
  [[nodiscard]] SymMat3<float> A() const { return {v[0][3], v[1][0], v[1][1], v[1][2], v[1][3], v[2][0]}; }
  [[nodiscard]] Vec3f b() const { return {v[2][1], v[2][2], v[2][3]}; }

  Float4 v[3];
};

template <int i>
Vec3f column(const SymMat3<float>& A) {
  if constexpr (i == 0) return {A.xx, A.xy, A.xz};
  if constexpr (i == 1) return {A.xy, A.yy, A.yz};
  if constexpr (i == 2) return {A.xz, A.yz, A.zz};
}

/// True for the diagonal from corner 0 to 2, false for 1 to 3: where the summed error of the four vertices, taken at
/// the diagonal's middle, is not larger.
///
/// About the edge's low end that sum is mᵀSm − 2hᵀm with S = ΣAₖ and h = Σ(Aₖrₖ + bₖ), where rₖ, a corner of a cube of
/// edge 1, is the centre of cell k. With s and t twice the middles, the errors differ by a quarter of
/// (s − t)ᵀ(S(s + t) − 4h). In 4h the rₖ turn into signs, and half along the axis, which all of them have and s + t has
/// four times, drops out: vertices may be taken from the centres of their cells.
template <int axis>
bool splitsAtFirst(const std::array<const VertexError*, 4>& error) {
  const PackedError e0(*error[0]), e1(*error[1]), e2(*error[2]), e3(*error[3]);
  const PackedError e02 = e0 + e2, e13 = e1 + e3, sum = e02 + e13;
  const PackedError p = e0 - e2, q = e1 - e3, alongU = p - q, alongV = p + q;
  const Vec3f h4 = sum.b() * 4.0F + (column<(axis + 1) % 3>(alongU.A()) + column<(axis + 2) % 3>(alongV.A())) * 2.0F;
  const Vec3f difference = e02.x() - e13.x();
  return !(dot(difference, sum.A() * sum.x() - h4) > 0);
}

/// Whether the lattice edge passes from behind to before the planes of both triangles of a quad that is split along the
/// diagonal from corner 0 to 2, or 1 to 3: a quick test that may say no in vain, but not yes.
/// \param doubt what rounding may add to, or take from, the volumes that this looks at.
template <int axis>
bool passes(const std::array<const VertexError*, 4>& error, bool first, float doubt) {
  std::array<Vec3f, 4> p;
  for (int k = 0; k < 4; ++k) {
    p[k] = error[k]->x + Vec3f{0.5F, 0.5F, 0.5F};
    p[k][(axis + 1) % 3] -= static_cast<float>(kRing[k][0]);
    p[k][(axis + 2) % 3] -= static_cast<float>(kRing[k][1]);
  }
  const auto crosses = [doubt](const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Vec3f n = cross(b - a, c - a);
    const float low = dot(n, a), high = n[axis] - low;
    return low > doubt && high > doubt;
  };
  return first ? crosses(p[0], p[1], p[2]) && crosses(p[0], p[2], p[3])
               : crosses(p[1], p[2], p[3]) && crosses(p[1], p[3], p[0]);
}

/// Of triple products of three places not farther than a cell from a lattice point: what single precision does to
/// their sums, and what rounding the places in world space does.
float volumeDoubt(const LatticeMap& map, const Coord& block) {
  constexpr double kArithmetic = 1e-5, kPerRounding = 16;
  return static_cast<float>(kArithmetic + kPerRounding * cellRounding(map, block));
}

}  // namespace

inline void BlockFaceWriter::write(const Quad& v, bool splitsAtFirst, bool reversed, std::uint64_t face) const {
  // Selections, not branches: neither side can be foreseen.
  const unsigned start = splitsAtFirst ? 0 : 1, step = reversed ? 3 : 1;
  Quad q;
  for (unsigned k = 0; k < 4; ++k) q[k] = v[(start + k * step) & 3];
  mQuads[face] = q;
}

template <int axis>
void BlockFaceWriter::runAxis(std::size_t block, const CellVertices& vertices, const ErrorWindow& errors,
                              Doubts* doubts, std::uint64_t face) const {
  constexpr int kStepU = CellVertices::kStep[(axis + 1) % 3], kStepV = CellVertices::kStep[(axis + 2) % 3];
  const BlockTopology& own = mTopology.blocks[block];
  const BlockSigns& signs = mBlocks.signs[block];
  const QuadRings rings(mBlocks, mTopology);
  const float doubt = doubts != nullptr ? volumeDoubt(mMap, mBlocks.coords[block]) : 0.0F;
  for (int x = 0; x < kBlockSize; ++x)
    for (std::uint64_t w = own.edges[axis].word[x]; w != 0; w &= w - 1) {
      const int bit = std::countr_zero(w), y = bit >> 3, z = bit & 7;
      const EdgeRef edge{static_cast<std::int32_t>(block), static_cast<std::uint16_t>(512 * axis + 64 * x + bit)};
      Quad ring;
      if (vertices.allSimple()) {
        const std::uint32_t* at = vertices.at(x, y, z);
        for (int k = 0; k < 4; ++k) ring[k] = at[-(kRing[k][0] * kStepU + kRing[k][1] * kStepV)];
      } else {
        ring = rings.vertices(edge);
      }
      std::array<const VertexError*, 4> error;
      for (int k = 0; k < 4; ++k) error[k] = &errors[ring[k]];
      bool first = splitsAtFirst<axis>(error);
      if (doubts != nullptr && !passes<axis>(error, first, doubt)) {
        if (passes<axis>(error, !first, doubt)) {
          first = !first;
          ++doubts->forcedDiagonals;
        } else {
          doubts->quads.push_back(edge);
        }
      }
      write(ring, first, signs.inside(x, y, z) == mMap.mirrored(), face++);
    }
}

void BlockFaceWriter::run(std::size_t block, const ErrorWindow& errors, Doubts* doubts) const {
  forEachBlock(mLevel, 1, [&](std::size_t) {
    const BlockTopology& own = mTopology.blocks[block];
    const CellVertices vertices(mTopology, own);
    const auto x = own.firstQuad, y = x + own.edges[0].count(), z = y + own.edges[1].count();
    runAxis<0>(block, vertices, errors, doubts, x);
    runAxis<1>(block, vertices, errors, doubts, y);
    runAxis<2>(block, vertices, errors, doubts, z);
  });
}

}  // namespace pdc::detail
