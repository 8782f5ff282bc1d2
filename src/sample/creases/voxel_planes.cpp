#include "sample/creases/voxel_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/lane_loops.h"
#include "sample/creases/gradient_jumps.h"

namespace pdc::detail {
namespace {

/// Mixed second differences up to this are curvature, not a crease that cuts through an octant.
constexpr float kCurvature = 0.03F;
/// Samples whose foot is this far from a cell, in voxels, tell it nothing.
constexpr float kFootReach = 1.2F;

constexpr auto kStep = DistanceStencil::kStep;
constexpr int kOctants = SurfaceSamples::kOctants;

using Lanes = std::array<float, kLanes>;

/// What a row of voxels sees, a voxel per lane.
struct VoxelRow {
  /// Lanes by twice the axis, from below, and from above at one more.
  alignas(64) std::array<float, 3 * 2 * kLanes> slope;
  /// Lanes by octant: how far its face diagonals miss what it predicts.
  std::array<float, kOctants * kLanes> missed;
  std::array<Lanes, 3> apart;                ///< By axis; infinite where the two slopes differ, 0 elsewhere.
  std::array<std::int32_t, kLanes> octants;  ///< Bit o: it has slopes of its own, and its diagonals agree with them.
};

}  // namespace

/// What is to be looked at, in the voxels of one row after the other: an octant each, whose slopes and the like are a
/// lane.
struct OctantList {
  static constexpr int kPerRow = kLanes * kOctants, kCapacity = 4 * kPerRow;
  using Column = std::array<float, kCapacity>;

  [[nodiscard]] bool hasRoom() const { return count + kPerRow <= kCapacity; }
  /// Adds the octants of eight voxels. \param z of the first in the row. \param octants a byte per voxel.
  void add(const VoxelRow& row, const float* first, int rowStart, int z, std::uint64_t octants);

  alignas(64) std::array<Column, 3> slope;
  alignas(64) Column missed, value;
  alignas(64) std::array<std::int32_t, kCapacity> voxel;  ///< 256x + 16y + z, each from -1.
  int count = 0;
};

inline void OctantList::add(const VoxelRow& row, const float* first, int rowStart, int z, std::uint64_t octants) {
  const float *slopes = &row.slope[z], *misses = &row.missed[z];
  first += z;
  const int firstVoxel = rowStart + z;
  int n = count;
  for (; octants != 0; octants &= octants - 1, ++n) {
    const auto bit = static_cast<unsigned>(std::countr_zero(octants)), v = bit / kOctants, octant = bit % kOctants;
    slope[0][n] = slopes[v + octant % 2 * kLanes];
    slope[1][n] = slopes[v + (2 + octant / 2 % 2) * kLanes];
    slope[2][n] = slopes[v + (4 + octant / 4) * kLanes];
    missed[n] = misses[v + octant * kLanes];
    value[n] = first[v];
    voxel[n] = firstVoxel + static_cast<int>(v);
  }
  count = n;
}

namespace {

constexpr std::uint64_t kEachByte = 0x0101010101010101;

/// Byte k is full where bit k is set.
std::uint64_t spread(unsigned bits) {
  constexpr std::uint64_t kDiagonal = 0x8040201008040201;
  return (((bits * kEachByte & kDiagonal) + 0x7F * kEachByte) >> 7 & kEachByte) * 0xFF;
}

/// Byte k is the number of bits that are set in the bytes below it.
std::uint64_t countBelow(std::uint64_t bits) {
  bits -= bits >> 1 & 0x55 * kEachByte;
  bits = (bits & 0x33 * kEachByte) + (bits >> 2 & 0x33 * kEachByte);
  return ((bits + (bits >> 4)) & 0x0F * kEachByte) * kEachByte << 8;
}

/// \param first of the row's values in the stencil.
template <int lanes>
void findSlopes(SimdLevel level, const float* first, float jump, VoxelRow& row) {
  forEachBatch(level, 3, [&](std::size_t axis) {
    const int step = kStep[axis];
    float *below = &row.slope[2 * axis * kLanes], *above = below + kLanes;
    float* apart = row.apart[axis].data();
    forEachLane<lanes>([&](int lane) {
      const float* p = first + lane;
      const OneSidedSlopes s(p, step);
      // Where both agree, the central difference is the most exact.
      const float central = 0.5F * (p[step] - p[-step]);
      const bool smooth = std::abs(s.above - s.below) <= jump;
      below[lane] = smooth ? central : s.below;
      above[lane] = smooth ? central : s.above;
      apart[lane] = smooth ? 0.0F : std::numeric_limits<float>::infinity();
    });
  });
}

/// Which octants of each voxel have slopes of their own and face diagonals that agree with them. One loop of straight
/// code, because the compiler unrolls shorter ones before it can vectorise them.
template <int lanes>
void findOctants(SimdLevel level, const float* first, float mostMissed, VoxelRow& row) {
  withSimd(level, [&] {
    forEachLane<lanes>([&](int lane) {
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
      // do not jump.
      for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < kOctants / 2; ++k) {
          const int low = (k >> axis << (axis + 1)) | (k & ((1 << axis) - 1));
          const float a = missed[low], b = missed[low | 1 << axis] + row.apart[axis][lane];
          missed[low] = b < a ? b : a;
        }
      std::int32_t octants = 0;
      for (int o = 0; o < kOctants; ++o) {
        octants |= std::int32_t(missed[o] < mostMissed) << o;
        row.missed[o * kLanes + lane] = missed[o];
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

/// The sample of each octant; those that are not believed have no weight. \param to by SurfaceSamples::Column.
void findSamples(SimdLevel level, const OctantList& list, const PlaneTolerance& tolerance, const Mat3f& K,
                 const std::array<float*, SurfaceSamples::kColumns>& to) {
  forEachBatch(level, batchCount(static_cast<std::size_t>(list.count)), [&](std::size_t block) {
    const std::size_t begin = block * kLanes;
    const float *sx = &list.slope[0][begin], *sy = &list.slope[1][begin], *sz = &list.slope[2][begin],
                *missedOf = &list.missed[begin], *valueOf = &list.value[begin];
    const std::int32_t* voxel = &list.voxel[begin];
    float *normalX = to[SurfaceSamples::kNormalX] + begin, *normalY = to[SurfaceSamples::kNormalY] + begin,
          *normalZ = to[SurfaceSamples::kNormalZ] + begin, *footX = to[SurfaceSamples::kFootX] + begin,
          *footY = to[SurfaceSamples::kFootY] + begin, *footZ = to[SurfaceSamples::kFootZ] + begin,
          *weightOf = to[SurfaceSamples::kWeight] + begin, *trustOf = to[SurfaceSamples::kTrust] + begin;
    forEachLane([&](int lane) {
      const float rx = sx[lane], ry = sy[lane], rz = sz[lane];
      const float gx = rx * K.row[0].x + ry * K.row[1].x + rz * K.row[2].x,
                  gy = rx * K.row[0].y + ry * K.row[1].y + rz * K.row[2].y,
                  gz = rx * K.row[0].z + ry * K.row[1].z + rz * K.row[2].z;
      const float l = std::sqrt(gx * gx + gy * gy + gz * gz), off = std::abs(l - 1), missed = missedOf[lane];
      const float error = missed < off ? off : missed, e = error / tolerance.error, fall = 1 - e * e,
                  excess = error / tolerance.usual, damping = 1 + excess * excess, inverseLength = 1 / l;
      const bool believed = error < tolerance.error;
      const float weight = believed ? fall * fall : 0.0F, value = valueOf[lane];
      const float nx = believed ? gx * inverseLength : 0.0F, ny = believed ? gy * inverseLength : 0.0F,
                  nz = believed ? gz * inverseLength : 0.0F;
      const std::int32_t v = voxel[lane];
      const auto x = static_cast<float>((v >> 8) - 1), y = static_cast<float>((v >> 4 & 15) - 1),
                 z = static_cast<float>((v & 15) - 1);
      normalX[lane] = nx;
      normalY[lane] = ny;
      normalZ[lane] = nz;
      footX[lane] = x - (nx * K.row[0].x + ny * K.row[0].y + nz * K.row[0].z) * value;
      footY[lane] = y - (nx * K.row[1].x + ny * K.row[1].y + nz * K.row[1].z) * value;
      footZ[lane] = z - (nx * K.row[2].x + ny * K.row[2].y + nz * K.row[2].z) * value;
      weightOf[lane] = weight;
      trustOf[lane] = weight / (damping * damping);
    });
  });
}

/// Makes feet relative to the centre of a cell, and weighs samples by them.
inline void weighByFoot(const Vec3f& center, const Mat3f& M, SurfaceSamples& samples) {
  for (int block = 0; block < samples.blocks(); ++block) {
    const auto column = [&](int c) { return &samples.column[c][block * kLanes]; };
    float *fx = column(SurfaceSamples::kFootX), *fy = column(SurfaceSamples::kFootY),
          *fz = column(SurfaceSamples::kFootZ), *weight = column(SurfaceSamples::kWeight),
          *trust = column(SurfaceSamples::kTrust);
    forEachLane([&](int lane) {
      const Vec3f d = Vec3f{fx[lane], fy[lane], fz[lane]} - center;
      const auto beyond = [](float v) {
        const float over = std::abs(v) - 0.5F;
        return (over > 0 ? over : 0.0F) / kFootReach;
      };
      const float a = beyond(d.x), b = beyond(d.y), c = beyond(d.z), far = a * a + b * b + c * c;
      const float near = far < 1 ? (1 - far) * (1 - far) : 0.0F;
      const Vec3f world = M * d;
      fx[lane] = world.x;
      fy[lane] = world.y;
      fz[lane] = world.z;
      weight[lane] = weight[lane] * near;
      trust[lane] = trust[lane] * near;
    });
  }
}

}  // namespace

void VoxelPlanes::find() {
  OctantList list;
  int first = 0;  // Row whose octants have no samples yet.
  const auto sample = [&](int end) {
    std::array<float*, SurfaceSamples::kColumns> to;
    for (int c = 0; c < SurfaceSamples::kColumns; ++c) to[c] = &mColumn[c][mCount];
    findSamples(mLevel, list, mTolerance, mK, to);
    mCount += list.count;
    list.count = 0;
    for (; first < end; ++first)
      if (mNeeded[first] != 0) dropWeightless(first);
  };
  for (int row = 0; row < kVoxels * kVoxels; ++row) {
    if (mNeeded[row] == 0) continue;
    if (!list.hasRoom()) sample(row);
    addRow(row, list);
  }
  sample(kVoxels * kVoxels);
  mFound = true;
}

void VoxelPlanes::addRow(int row, OctantList& list) {
  constexpr int kHalf = kLanes / 2;
  // Voxels that are needed mostly fit into half the lanes, from the first of them on.
  const unsigned needed = mNeeded[row];
  const int low = std::countr_zero(needed), x = row / kVoxels, y = row % kVoxels;
  const bool fit = needed >> low < 1U << kHalf;
  const float* values = &mStencil.value[DistanceStencil::index(x - 1, y - 1, low - 1)];
  VoxelRow voxels;
  if (fit) {
    findSlopes<kHalf>(mLevel, values, mTolerance.jump, voxels);
    findOctants<kHalf>(mLevel, values, mTolerance.error, voxels);
  } else {
    findSlopes<kLanes>(mLevel, values, mTolerance.jump, voxels);
    findOctants<kLanes>(mLevel, values, mTolerance.error, voxels);
  }
  static_assert(std::endian::native == std::endian::little);
  RowStarts& start = mStart[row];
  std::fill_n(start.begin(), low, static_cast<std::uint16_t>(mCount + list.count));
  for (int z = 0; z < (fit ? kHalf : kLanes); z += kHalf) {
    std::uint64_t octants = 0;
    for (int k = 0; k < kHalf; ++k) octants |= static_cast<std::uint64_t>(voxels.octants[z + k]) << 8 * k;
    octants &= spread(needed >> (low + z) & 0xFF);
    const std::uint64_t below = countBelow(octants);
    for (int k = 0; k < kHalf; ++k)
      start[low + z + k] = static_cast<std::uint16_t>(mCount + list.count + int(below >> 8 * k & 0xFF));
    list.add(voxels, values, x << 8 | y << 4 | low, z, octants);
  }
  std::fill(start.begin() + low + (fit ? kHalf : kLanes), start.end(), static_cast<std::uint16_t>(mCount + list.count));
}

void VoxelPlanes::dropWeightless(int row) {
  constexpr int kMost = 3;
  RowStarts& start = mStart[row];
  for (int v = 0; v < kVoxels; ++v)
    if (start[v + 1] - start[v] > kMost) keepHeaviest(kMost, start[v], start[v + 1]);
  const float* weight = mColumn[SurfaceSamples::kWeight].data();
  const int end = start[kVoxels];
  int kept = start[0];
  while (kept < end && weight[kept] > 0) ++kept;
  if (kept == end) return;
  // Without branches, which no processor would foresee.
  std::array<std::uint16_t, kVoxels * kOctants + 1> place;
  const int begin = kept;
  for (int i = begin; i < end; ++i) {
    place[i - begin] = static_cast<std::uint16_t>(kept);
    for (auto& column : mColumn) column[kept] = column[i];
    kept += weight[i] > 0 ? 1 : 0;
  }
  place[end - begin] = static_cast<std::uint16_t>(kept);
  for (int v = 0; v <= kVoxels; ++v)
    if (start[v] >= begin) start[v] = place[start[v] - begin];
}

void VoxelPlanes::keepHeaviest(int most, int begin, int end) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  float *weight = mColumn[SurfaceSamples::kWeight].data(), *trust = mColumn[SurfaceSamples::kTrust].data();
  int left = 0;
  for (int i = begin; i < end; ++i) left += weight[i] > 0 ? 1 : 0;
  for (; left > most; --left) {
    int lightest = begin;
    float least = kNone;
    for (int i = begin; i < end; ++i) {
      const float w = weight[i] > 0 ? weight[i] : kNone;
      const bool lighter = w < least;
      lightest = lighter ? i : lightest;
      least = lighter ? w : least;
    }
    weight[lightest] = trust[lightest] = 0;
  }
}

void VoxelPlanes::request(const Coord& cell) {
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      mNeeded[kVoxels * (cell[0] + x) + cell[1] + y] |= static_cast<std::uint16_t>(0xF << cell[2]);
}

void VoxelPlanes::gather(const Coord& cell, SurfaceSamples& samples) {
  if (!mFound) find();
  const Vec3f center{float(cell[0]) + 0.5F, float(cell[1]) + 0.5F, float(cell[2]) + 0.5F};
  const RowStarts* const rowStarts = &mStart[kVoxels * cell[0] + cell[1]];
  withSimd(mLevel, [&] {
    // Of its own, so that no store can change them.
    const RowStarts* const rows = rowStarts;
    const Columns& from = mColumn;
    auto& to = samples.column;
    const int z = cell[2];
    int n = 0;
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 4; ++y) {
        const RowStarts& start = rows[kVoxels * x + y];
        const int begin = start[z], count = start[z + 4] - begin;
        // Whole vectors, of which the next row overwrites what is too much.
        using Vector = float __attribute__((vector_size(32)));
        for (int i = 0; i < count; i += int{sizeof(Vector) / sizeof(float)})
          for (int c = 0; c < SurfaceSamples::kColumns; ++c) {
            Vector v;
            std::memcpy(&v, &from[c][begin + i], sizeof v);
            std::memcpy(&to[c][n + i], &v, sizeof v);
          }
        n += count;
      }
    // What lies behind the last must not spoil sums, whatever it is.
    for (auto& column : to) std::memset(&column[n], 0, kLanes * sizeof(float));
    samples.count = n;
    weighByFoot(center, mM, samples);
  });
}

}  // namespace pdc::detail
