#include "sample/stencils/gradient_stencil.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "math/lane_loops.h"
#include "sample/creases/one_sided_slopes.h"

namespace pdc::detail {
namespace {

/// Finds crossings and normals of the edges along one axis. Written for one edge, without branches, and vectorised over
/// sixteen.
struct AxisKernel {
  const float* value;
  const int* point;  ///< Index in the stencil of each edge's lower end.
  int step, stepU, stepV;
  SlopeLimits limits;
  Mat3<float> map;  ///< From (along, u, v) to world.
  float *t, *nx, *ny, *nz;

  [[nodiscard]] int usable(float v) const { return int(v > limits.low) & int(v < limits.high); }

  /// Slope at p along a lattice direction: central, or one-sided where a neighbour is clamped.
  [[nodiscard]] float slope(const float* p, int s) const {
    const float below = p[-s], here = p[0], above = p[s];
    const int a = usable(above), b = usable(below), h = usable(here);
    const float oneSided = a != 0 ? above - here : here - below;
    // Always computed: values read under a condition would keep the loop over lanes from being vectorised.
    const float central = centralSlope(p, s);
    const float chosen = (h & (a ^ b)) != 0 ? oneSided : central;
    return (h & (a ^ 1) & (b ^ 1)) != 0 ? 0.0F : chosen;
  }

  void operator()(int i) const {
    const float* p = value + point[i];
    const float* q = p + step;
    const float v0 = p[0], v1 = q[0];
    // Both may be zero; see placeIsovalueCrossings().
    const float ratio = v0 == v1 ? 0.0F : v0 / (v0 - v1);
    // NaN where an end is not finite.
    const float at = ratio >= 0 ? (ratio <= 1 ? ratio : 0.5F) : 0.5F;
    const float along = v1 - v0;
    const float u = (1 - at) * slope(p, stepU) + at * slope(q, stepU);
    const float v = (1 - at) * slope(p, stepV) + at * slope(q, stepV);
    const float gx = map.row[0].x * along + map.row[0].y * u + map.row[0].z * v;
    const float gy = map.row[1].x * along + map.row[1].y * u + map.row[1].z * v;
    const float gz = map.row[2].x * along + map.row[2].y * u + map.row[2].z * v;
    // The largest component is divided out first: the square of a float may overflow.
    const float ax = std::abs(gx), ay = std::abs(gy), az = std::abs(gz);
    const float xy = ax > ay ? ax : ay, largest = xy > az ? xy : az;
    const float inverse = 1 / largest;
    const float x = gx * inverse, y = gy * inverse, z = gz * inverse;
    const float scale = 1 / std::sqrt(x * x + y * y + z * z);
    const float known = x * scale + y * scale + z * scale;  // NaN where any of it is.
    t[i] = at;
    nx[i] = known == known ? x * scale : 0.0F;
    ny[i] = known == known ? y * scale : 0.0F;
    nz[i] = known == known ? z * scale : 0.0F;
  }
};

/// Rows along z of a stencil: row (x, y) is bit y + 1 of number x + 1.
using RowBits = std::array<unsigned, GradientStencil::kPoints>;

/// Where the low ends of a block's edges along one axis lie.
struct LowEnds {
  RowBits rows{};
  bool atLowestZ = false;  ///< One of them has z = 0.
};
LowEnds findLowEnds(const EdgeIndex& edges, int axis) {
  LowEnds ends;
  const std::uint16_t* point = edges.points();
  for (int i = edges.begin(axis); i < edges.begin(axis + 1); ++i) {
    ends.rows[(point[i] >> 8) + 1] |= 2u << (point[i] >> 4 & 15);
    ends.atLowestZ |= (point[i] & 15) == 0;
  }
  return ends;
}

/// Adds the rows of both ends of edges along an axis, and of the ends' neighbours on the other two axes.
void addNeighbours(const RowBits& lowEnds, int axis, RowBits& needed) {
  for (int x = 1; x <= kBlockPoints; ++x) {
    const unsigned low = lowEnds[x], both = axis == 1 ? low | low << 1 : low,
                   withY = axis == 1 ? both : both | both >> 1 | both << 1;
    needed[x] |= withY;
    if (axis == 0) {
      needed[x + 1] |= withY;
    } else {
      needed[x - 1] |= both;
      needed[x + 1] |= both;
    }
  }
}

/// See GradientStencilRows::parts().
unsigned partsOf(const RowBits& needed) {
  std::array<unsigned, 3> rows{};
  for (int x = 0; x < GradientStencil::kPoints; ++x) rows[GradientStencil::part(x - 1)] |= needed[x];
  constexpr std::array<unsigned, 3> kRowsOfPart{1, 0xFF << 1, 3 << 9};
  unsigned parts = 0;
  for (int part = 0; part < 9; ++part) parts |= unsigned{(rows[part / 3] & kRowsOfPart[part % 3]) != 0} << part;
  return parts;
}

}  // namespace

GradientStencilRows::GradientStencilRows(const EdgeIndex& edges) {
  RowBits needed{};
  for (int axis = 0; axis < 3; ++axis) {
    const LowEnds ends = findLowEnds(edges, axis);
    addNeighbours(ends.rows, axis, needed);
    // Slopes along z are taken where edges along the other axes end.
    mBelow = mBelow || (axis != 2 && ends.atLowestZ);
  }
  mParts = partsOf(needed);
  constexpr int n = GradientStencil::kPoints;
  constexpr int kAtOnce = 5;  // Layers that fit into a word: the end of a loop over few bits is mispredicted.
  for (int first = 0; first < n; first += kAtOnce) {
    std::uint64_t word = 0;
    for (int x = first; x < n && x < first + kAtOnce; ++x) word |= std::uint64_t{needed[x]} << n * (x - first);
    for (; word != 0; word &= word - 1) mRow[mSize++] = static_cast<std::uint8_t>(n * first + std::countr_zero(word));
  }
}

void fillFromStencil(const GradientStencil& stencil, const EdgeIndex& edges, const SlopeLimits& limits,
                     const Mat3<float>& normalMap, HermiteBlock& hermite, SimdLevel level) {
  static_assert(HermiteBlock::kCapacity >= EdgeIndex::kMaxEdges + kLanes);
  std::array<int, HermiteBlock::kCapacity> point;
  for (int axis = 0; axis < 3; ++axis) {
    const int begin = edges.begin(axis), count = edges.begin(axis + 1) - begin;
    if (count == 0) continue;
    const int blocks = static_cast<int>(batchCount(static_cast<std::size_t>(count)));
    const std::uint16_t* packed = edges.points() + begin;
    forEachBatch(level, static_cast<std::size_t>(blocks), [&](std::size_t block) {
      forEachLane([to = &point[block * kLanes], from = packed + block * kLanes](int i) {
        const int p = from[i];
        to[i] = GradientStencil::index(p >> 8, p >> 4 & 15, p & 15);
      });
    });
    std::fill(point.begin() + count, point.begin() + blocks * kLanes, point[0]);

    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Mat3<float> map;
    for (int r = 0; r < 3; ++r) map.row[r] = {normalMap.row[r][axis], normalMap.row[r][u], normalMap.row[r][v]};
    // Later axes overwrite what the last register of this one writes beyond its end.
    const AxisKernel kernel{stencil.value.data(),
                            point.data(),
                            GradientStencil::kStep[axis],
                            GradientStencil::kStep[u],
                            GradientStencil::kStep[v],
                            limits,
                            map,
                            &hermite.t[begin],
                            &hermite.nx[begin],
                            &hermite.ny[begin],
                            &hermite.nz[begin]};
    forEachBatch(level, static_cast<std::size_t>(blocks), [&kernel](std::size_t block) {
      const int first = static_cast<int>(block) * kLanes;
      forEachLane([&](int lane) { kernel(first + lane); });
    });
  }
}

}  // namespace pdc::detail
