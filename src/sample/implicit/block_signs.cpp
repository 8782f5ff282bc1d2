#include "sample/implicit/block_signs.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pdc::detail {
namespace {

/// Visits every step-th point of the block, z fastest: visit(row 9x + y, z, inside).
template <int step, typename Visit>
void sample(const Field& field, const LatticeFrame& frame, const Coord& block, MissingPoints* missing, Visit&& visit) {
  constexpr int kPerAxis = kBlockSize / step + 1;
  constexpr int kPoints = kPerAxis * kPerAxis * kPerAxis;
  std::array<std::array<double, kPerAxis>, 3> axisPosition;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < kPerAxis; ++i) axisPosition[axis][i] = frame.at(axis, kBlockSize * block[axis] + i * step);

  std::array<double, Field::kMaxBatch> x, y, z, values;
  for (int first = 0; first < kPoints; first += static_cast<int>(Field::kMaxBatch)) {
    const std::size_t size = std::min(Field::kMaxBatch, static_cast<std::size_t>(kPoints - first));
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t n = static_cast<std::size_t>(first) + i;
      x[i] = axisPosition[0][n / (kPerAxis * kPerAxis)];
      y[i] = axisPosition[1][n / kPerAxis % kPerAxis];
      z[i] = axisPosition[2][n % kPerAxis];
    }
    field.values({x.data(), y.data(), z.data(), size}, values.data());
    for (std::size_t i = 0; i < size; ++i) {
      const int n = first + static_cast<int>(i);
      if (missing != nullptr && std::isnan(values[i]))
        missing->add({kBlockSize * block[0] + step * (n / (kPerAxis * kPerAxis)),
                      kBlockSize * block[1] + step * (n / kPerAxis % kPerAxis),
                      kBlockSize * block[2] + step * (n % kPerAxis)});
      visit(n / kPerAxis, n % kPerAxis, isInside(values[i]));
    }
  }
}

}  // namespace

void sampleSigns(const Field& field, const LatticeFrame& frame, const Coord& block, BlockSigns& signs,
                 MissingPoints* missing) {
  signs.row.fill(0);
  sample<1>(field, frame, block, missing, [&](int row, int z, bool inside) {
    signs.row[row] = static_cast<std::uint16_t>(signs.row[row] | unsigned{inside} << z);
  });
}

bool coarseSignsDiffer(const Field& field, const LatticeFrame& frame, const Coord& block, MissingPoints* missing) {
  bool anyInside = false, anyOutside = false;
  sample<4>(field, frame, block, missing, [&](int, int, bool inside) { (inside ? anyInside : anyOutside) = true; });
  return anyInside && anyOutside;
}

bool faceSignsDiffer(const BlockSigns& signs, int axis, bool upper) {
  constexpr int n = kBlockPoints;
  const int end = upper ? kBlockSize : 0;
  const unsigned mask = axis == 2 ? 1u << end : 0x1FFu;
  unsigned any = 0, all = mask;
  const auto add = [&](int row) {
    any |= signs.row[row] & mask;
    all &= signs.row[row];
  };
  if (axis == 2) {
    for (int row = 0; row < n * n; ++row) add(row);
  } else {
    for (int i = 0; i < n; ++i) add(axis == 0 ? n * end + i : n * i + end);
  }
  return any != all;
}

CellMask cellsWithin(const Coord& block, const Coord& cells) {
  CellMask mask;
  const auto limit = [&](int axis) { return std::clamp(cells[axis] - kBlockSize * block[axis], 0, kBlockSize); };
  for (int x = 0; x < limit(0); ++x)
    for (int y = 0; y < limit(1); ++y)
      for (int z = 0; z < limit(2); ++z) mask.set(x, y, z);
  return mask;
}

}  // namespace pdc::detail
