#include "sample/stencils/isovalue_points.h"

#include <bit>
#include <limits>
#include <vector>

#include "math/lane_loops.h"

namespace pdc::detail {
namespace {

constexpr std::uint64_t kLowestZ = 0x0101010101010101;

/// Whether any crossing lies at an end of its edge, as it does if the value there is zero.
bool anyAtEnd(const HermiteBlock& hermite, int size) {
  int any = 0;
  for (int i = 0; i < size; ++i) any |= int(hermite.t[i] == 0) | int(hermite.t[i] == 1);
  return any != 0;
}

/// Below zero and finite: other values are not inside.
bool isFinitelyInside(float v) { return v < 0 && v >= std::numeric_limits<float>::lowest(); }

/// The mean of the values that a point lies between, along those axes that `known` has and that have both inside; 0 if
/// there are none.
float meanBetween(const float* p, const std::array<int, 3>& step, const std::array<bool, 3>& known) {
  double sum = 0;  // Sums of large floats may overflow.
  int count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!known[axis]) continue;  // There may be nothing to read.
    const float below = p[-step[axis]], above = p[step[axis]];
    if (!isFinitelyInside(below) || !isFinitelyInside(above)) continue;
    sum += double{below} + double{above};
    count += 2;
  }
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

inline bool hasZero(const float* row) {
  int any = 0;
  for (int i = 0; i < kLanes; ++i) any |= int(row[i] == 0);
  return any != 0;
}

/// A row of a stencil that was read, along z.
struct StencilRow {
  int x, y;
};

/// The rows that hold a zero: nearly always none.
std::vector<StencilRow> rowsWithZeros(const DistanceStencil& stencil) {
  std::vector<StencilRow> found;
  withSimd(bestSimdLevel(), [&] {
    for (int x = 0; x < DistanceStencil::kPoints; ++x)
      for (unsigned ys = stencil.rows[x]; ys != 0; ys &= ys - 1) {
        const int y = std::countr_zero(ys);
        if (hasZero(&stencil.value[(DistanceStencil::kPoints * x + y) * kLanes])) found.push_back({x, y});
      }
  });
  return found;
}

}  // namespace

CellMask pointsBetween(const CellMask& own, const std::array<CellMask, 6>& around) {
  CellMask between;
  constexpr int kLast = kBlockSize - 1;
  for (int x = 0; x < kBlockSize; ++x) {
    const std::uint64_t w = own.word[x];
    const std::uint64_t belowX = x > 0 ? own.word[x - 1] : around[0].word[kLast];
    const std::uint64_t aboveX = x < kLast ? own.word[x + 1] : around[1].word[0];
    const std::uint64_t belowY = w << 8 | around[2].word[x] >> 56, aboveY = w >> 8 | around[3].word[x] << 56;
    const std::uint64_t belowZ = (w << 1 & ~kLowestZ) | (around[4].word[x] >> 7 & kLowestZ);
    const std::uint64_t aboveZ = (w >> 1 & ~(kLowestZ << 7)) | (around[5].word[x] << 7 & kLowestZ << 7);
    between.word[x] = (belowX & aboveX) | (belowY & aboveY) | (belowZ & aboveZ);
  }
  return between;
}

void placeIsovalueCrossings(const GradientStencil& stencil, const BlockSigns& signs, const EdgeIndex& edges,
                            HermiteBlock& hermite) {
  if (!anyAtEnd(hermite, edges.size())) return;
  edges.forEach([&](int i, int axis, int x, int y, int z) {
    const float* low = &stencil.value[GradientStencil::index(x, y, z)];
    const float* high = low + GradientStencil::kStep[axis];
    const bool lowInside = signs.inside(x, y, z);
    const float* inside = lowInside ? low : high;
    const float outsideValue = lowInside ? *high : *low;
    if (*inside != 0) return;
    // Along the edge the point lies between nothing, and its neighbour below was perhaps not read.
    const float value = meanBetween(inside, GradientStencil::kStep, {axis != 0, axis != 1, axis != 2});
    const float fromInside = value < outsideValue ? value / (value - outsideValue) : 1;
    hermite.t[i] = lowInside ? fromInside : 1 - fromInside;
  });
}

void fillIsovaluePoints(DistanceStencil& stencil) {
  constexpr int kPoints = DistanceStencil::kPoints;
  struct Point {
    float* at;
    float value;
  };
  std::vector<Point> points;  // All are found before any changes.
  const auto isRead = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < kPoints && y < kPoints && (stencil.rows[x] >> y & 1) != 0;
  };
  for (const auto& [x, y] : rowsWithZeros(stencil)) {
    float* row = &stencil.value[(kPoints * x + y) * kLanes];
    const std::array<bool, 3> known{isRead(x - 1, y) && isRead(x + 1, y), isRead(x, y - 1) && isRead(x, y + 1), true};
    for (int z = 1; z + 1 < kLanes; ++z) {
      const float value = row[z] == 0 ? meanBetween(row + z, DistanceStencil::kStep, known) : 0;
      if (value < 0) points.push_back({row + z, value});
    }
  }
  for (const Point& p : points) *p.at = p.value;
}

}  // namespace pdc::detail
