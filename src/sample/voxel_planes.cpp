#include "sample/voxel_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "math/lane_loops.h"
#include "sample/kinks.h"

namespace pdc::detail {
namespace {

/// Mixed second differences up to this are curvature, not a crease that cuts through an octant.
constexpr float kCurvature = 0.03F;
/// Samples whose foot is this far from a cell, in voxels, tell it nothing.
constexpr float kFootReach = 1.2F;

constexpr auto kStep = DistanceWindow::kStep;
constexpr int kOctants = SurfaceSamples::kOctants;

using Lanes = std::array<float, kLanes>;

/// What a row of voxels sees, a voxel per lane.
struct VoxelRow {
  alignas(64) std::array<std::array<Lanes, 2>, 3> slope;  ///< By axis; from below and from above.
  std::array<Lanes, kOctants> missed;                     ///< How far an octant's face diagonals miss what it predicts.
  std::array<Lanes, 3> apart;                ///< By axis; infinite where the two slopes differ, 0 elsewhere.
  std::array<std::int32_t, kLanes> octants;  ///< Bit o: it has slopes of its own, and its diagonals agree with them.
};

/// What is to be looked at in a row: octants of voxels, as 8 times the voxel's lane plus the octant.
struct RowItems {
  std::array<std::uint8_t, kLanes * kOctants> item;
  int count = 0;
};

/// \param first of the row's values in the window.
void findSlopes(SimdLevel level, const float* first, float kink, VoxelRow& row) {
  forEachBlock(level, 3, [&](std::size_t axis) {
    const int step = kStep[axis];
    float *below = row.slope[axis][0].data(), *above = row.slope[axis][1].data();
    float* apart = row.apart[axis].data();
    forEachLane([&](int lane) {
      const float* p = first + lane;
      const OneSidedSlopes s(p, step);
      // Where both agree, the central difference is the most exact.
      const float central = 0.5F * (p[step] - p[-step]);
      const bool smooth = std::abs(s.above - s.below) <= kink;
      below[lane] = smooth ? central : s.below;
      above[lane] = smooth ? central : s.above;
      apart[lane] = smooth ? 0.0F : std::numeric_limits<float>::infinity();
    });
  });
}

/// Which octants of each voxel have slopes of their own and face diagonals that agree with them. One loop of straight
/// code, because the compiler unrolls shorter ones before it can vectorise them.
void findOctants(SimdLevel level, const float* first, float mostMissed, VoxelRow& row) {
  forEachBlock(level, 1, [&](std::size_t) {
    forEachLane([&](int lane) {
      const float* p = first + lane;
      // How far the diagonals of the quadrants of each two axes, this one and the next, miss what their sides predict.
      float quadrant[3][4];
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 4; ++k) {
          const int u = (k & 1) != 0 ? kStep[axis] : -kStep[axis],
                    v = (k & 2) != 0 ? kStep[(axis + 1) % 3] : -kStep[(axis + 1) % 3];
          quadrant[axis][k] = std::abs(p[u + v] - p[u] - p[v] + p[0]);
        }
      float missed[kOctants];
      for (int o = 0; o < kOctants; ++o) {
        const float a = quadrant[0][o & 3], b = quadrant[1][o >> 1], c = quadrant[2][o >> 2 | (o & 1) << 1];
        const float ab = a < b ? b : a, abc = ab < c ? c : ab, sum = a + b + c;
        const float over = (abc < kCurvature ? kCurvature : abc) - kCurvature;
        missed[o] = sum == sum ? over : mostMissed;
      }
      // Of octants with the same slopes the one whose diagonals fit best speaks for all: the one below along axes that
      // are not kinked.
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < kOctants / 2; ++k) {
          const int low = (k >> axis << (axis + 1)) | (k & ((1 << axis) - 1));
          const float a = missed[low], b = missed[low | 1 << axis] + row.apart[axis][lane];
          missed[low] = b < a ? b : a;
        }
      std::int32_t octants = 0;
      for (int o = 0; o < kOctants; ++o) {
        octants |= std::int32_t(missed[o] < mostMissed) << o;
        row.missed[o][lane] = missed[o];
      }
      constexpr std::array<std::int32_t, 3> kAbove{0b10101010, 0b11001100, 0b11110000};
      for (int axis = 0; axis < 3; ++axis) {
        const std::int32_t joined = row.apart[axis][lane] == 0 ? kAbove[axis] : 0;
        octants &= ~joined;
      }
      row.octants[lane] = octants;
    });
  });
}

/// The octants of the voxels of `needed`, a bit each.
void listItems(const VoxelRow& row, unsigned needed, RowItems& items) {
  items.count = 0;
  for (; needed != 0; needed &= needed - 1) {
    const int z = std::countr_zero(needed);
    for (unsigned bits = static_cast<unsigned>(row.octants[z]); bits != 0; bits &= bits - 1)
      items.item[items.count++] = static_cast<std::uint8_t>(kOctants * z + std::countr_zero(bits));
  }
}

/// Slopes and the like of up to sixteen items.
struct ItemLanes {
  alignas(64) std::array<Lanes, 3> slope;
  Lanes missed, value, z;  // z from the row's first voxel.
};

void readItems(const VoxelRow& row, const float* first, std::span<const std::uint8_t> items, ItemLanes& lanes) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    const int z = items[i] / kOctants, o = items[i] % kOctants;
    for (int axis = 0; axis < 3; ++axis) lanes.slope[axis][i] = row.slope[axis][o >> axis & 1][z];
    lanes.missed[i] = row.missed[o][z];
    lanes.value[i] = first[z];
    lanes.z[i] = static_cast<float>(z);
  }
}

/// The sample of each item; those that are not believed have no weight. \param to by SurfaceSamples::Column.
void findSamples(SimdLevel level, const ItemLanes& item, const Vec3f& row, const PlaneTolerance& tolerance,
                 const Mat3f& K, const std::array<float*, SurfaceSamples::kColumns>& to) {
  forEachBlock(level, 1, [&](std::size_t) {
    forEachLane([&](int lane) {
      const float rx = item.slope[0][lane], ry = item.slope[1][lane], rz = item.slope[2][lane];
      const float gx = rx * K.row[0].x + ry * K.row[1].x + rz * K.row[2].x,
                  gy = rx * K.row[0].y + ry * K.row[1].y + rz * K.row[2].y,
                  gz = rx * K.row[0].z + ry * K.row[1].z + rz * K.row[2].z;
      const float l = std::sqrt(gx * gx + gy * gy + gz * gz), off = std::abs(l - 1), missed = item.missed[lane];
      const float error = missed < off ? off : missed, e = error / tolerance.error, fall = 1 - e * e,
                  excess = error / tolerance.usual, damping = 1 + excess * excess, inverseLength = 1 / l;
      const bool believed = error < tolerance.error;
      const float weight = believed ? fall * fall : 0.0F, value = item.value[lane];
      const float nx = believed ? gx * inverseLength : 0.0F, ny = believed ? gy * inverseLength : 0.0F,
                  nz = believed ? gz * inverseLength : 0.0F;
      to[SurfaceSamples::kNormalX][lane] = nx;
      to[SurfaceSamples::kNormalY][lane] = ny;
      to[SurfaceSamples::kNormalZ][lane] = nz;
      to[SurfaceSamples::kFootX][lane] = row.x - (nx * K.row[0].x + ny * K.row[0].y + nz * K.row[0].z) * value;
      to[SurfaceSamples::kFootY][lane] = row.y - (nx * K.row[1].x + ny * K.row[1].y + nz * K.row[1].z) * value;
      to[SurfaceSamples::kFootZ][lane] =
          row.z + item.z[lane] - (nx * K.row[2].x + ny * K.row[2].y + nz * K.row[2].z) * value;
      to[SurfaceSamples::kWeight][lane] = weight;
      to[SurfaceSamples::kTrust][lane] = weight / (damping * damping);
    });
  });
}

}  // namespace

void VoxelPlanes::find(int row) {
  const int x = row / kVoxels - 1, y = row % kVoxels - 1;
  const float* first = &mWindow.value[DistanceWindow::index(x, y, -1)];
  VoxelRow voxels;
  RowItems items;
  findSlopes(mLevel, first, mTolerance.kink, voxels);
  findOctants(mLevel, first, mTolerance.error, voxels);
  listItems(voxels, mNeeded[row], items);
  int z = 0;
  for (int i = 0; i < items.count; ++i)
    for (; z <= items.item[i] / kOctants; ++z) mStart[row][z] = static_cast<std::uint16_t>(mCount + i);
  for (; z <= kVoxels; ++z) mStart[row][z] = static_cast<std::uint16_t>(mCount + items.count);
  ItemLanes lanes{};
  for (int i = 0; i < items.count; i += kLanes) {
    const int size = std::min(items.count - i, kLanes);
    readItems(voxels, first, std::span(items.item).subspan(std::size_t(i), std::size_t(size)), lanes);
    std::array<float*, SurfaceSamples::kColumns> to;
    for (int c = 0; c < SurfaceSamples::kColumns; ++c) to[c] = &mColumn[c][mCount];
    findSamples(mLevel, lanes, {float(x), float(y), -1}, mTolerance, mK, to);
    mCount += size;
  }
  mNeeded[row] = 0;
  for (int v = 0; v < kVoxels; ++v) keepHeaviest(mStart[row][v], mStart[row][v + 1]);
  dropWeightless(row);
}

void VoxelPlanes::dropWeightless(int row) {
  auto& start = mStart[row];
  int kept = start[0];
  for (int v = 0; v < kVoxels; ++v) {
    const int begin = start[v], end = start[v + 1];
    start[v] = static_cast<std::uint16_t>(kept);
    for (int i = begin; i < end; ++i) {
      if (!(mColumn[SurfaceSamples::kWeight][i] > 0)) continue;
      for (auto& column : mColumn) column[kept] = column[i];
      ++kept;
    }
  }
  start[kVoxels] = static_cast<std::uint16_t>(kept);
  mCount = kept;
}

void VoxelPlanes::keepHeaviest(int begin, int end) {
  constexpr int kMost = 3;
  float *weight = mColumn[SurfaceSamples::kWeight].data(), *trust = mColumn[SurfaceSamples::kTrust].data();
  if (end - begin <= kMost) return;
  const auto counting = [&](int i) { return weight[i] > 0 ? weight[i] : std::numeric_limits<float>::infinity(); };
  auto left = std::count_if(weight + begin, weight + end, [](float w) { return w > 0; });
  for (; left > kMost; --left) {
    int lightest = begin;
    for (int i = begin + 1; i < end; ++i)
      if (counting(i) < counting(lightest)) lightest = i;
    weight[lightest] = trust[lightest] = 0;
  }
}

void VoxelPlanes::expect(const Coord& cell) {
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      mNeeded[kVoxels * (cell[0] + x) + cell[1] + y] |= static_cast<std::uint16_t>(0xF << cell[2]);
}

void VoxelPlanes::gather(const Coord& cell, SurfaceSamples& samples) {
  int n = 0;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      const int row = kVoxels * (cell[0] + x) + cell[1] + y;
      if (mNeeded[row] != 0) find(row);
      const int begin = mStart[row][cell[2]], end = mStart[row][cell[2] + 4];
      // Whole vectors, of which the next row overwrites what is too much.
      for (int c = 0; c < SurfaceSamples::kColumns; ++c)
        for (int i = 0; i < end - begin; i += kLanes)
          std::copy_n(&mColumn[c][begin + i], kLanes, &samples.column[c][n + i]);
      n += end - begin;
    }
  samples.count = n;
  const Vec3f center{float(cell[0]) + 0.5F, float(cell[1]) + 0.5F, float(cell[2]) + 0.5F};
  forEachBlock(mLevel, static_cast<std::size_t>(samples.blocks()), [&](std::size_t block) {
    const auto column = [&](int c) { return &samples.column[c][block * kLanes]; };
    float *fx = column(SurfaceSamples::kFootX), *fy = column(SurfaceSamples::kFootY),
          *fz = column(SurfaceSamples::kFootZ), *weight = column(SurfaceSamples::kWeight),
          *trust = column(SurfaceSamples::kTrust);
    const int left = n - static_cast<int>(block) * kLanes;
    forEachLane([&](int lane) {
      const Vec3f d = Vec3f{fx[lane], fy[lane], fz[lane]} - center;
      const auto beyond = [](float v) {
        const float over = std::abs(v) - 0.5F;
        return (over > 0 ? over : 0.0F) / kFootReach;
      };
      const float a = beyond(d.x), b = beyond(d.y), c = beyond(d.z), far = a * a + b * b + c * c;
      const float near = lane < left && far < 1 ? (1 - far) * (1 - far) : 0.0F;
      const Vec3f world = mM * d;
      fx[lane] = world.x;
      fy[lane] = world.y;
      fz[lane] = world.z;
      weight[lane] = near == 0 ? 0.0F : weight[lane] * near;
      trust[lane] = near == 0 ? 0.0F : trust[lane] * near;
    });
    // What lies behind the last must not spoil sums, whatever it is.
    for (int lane = std::max(left, 0); lane < kLanes; ++lane)
      for (int c = 0; c < SurfaceSamples::kColumns; ++c) column(c)[lane] = 0;
  });
}

}  // namespace pdc::detail
