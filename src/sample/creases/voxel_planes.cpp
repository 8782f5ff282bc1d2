#include "sample/creases/voxel_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "math/lane_loops.h"
#include "sample/creases/octant_bytes.h"

namespace pdc::detail {
namespace {

/// Samples whose foot point is this far from a cell, in voxels, tell it nothing.
constexpr float kFootReach = 1.2F;

/// Makes foot points relative to the centre of a cell, and takes support from samples by their distance from the cell.
inline void weighByDistance(const Vec3f& center, const Mat3f& M, SurfaceSamples& samples) {
  for (int block = 0; block < samples.blocks(); ++block) {
    const auto column = [&](int c) { return &samples.column[c][block * kLanes]; };
    float *fx = column(SurfaceSamples::kFootX), *fy = column(SurfaceSamples::kFootY),
          *fz = column(SurfaceSamples::kFootZ), *support = column(SurfaceSamples::kSupport),
          *fitWeight = column(SurfaceSamples::kFitWeight);
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
      support[lane] = support[lane] * near;
      fitWeight[lane] = fitWeight[lane] * near;
    });
  }
}

}  // namespace

void VoxelPlanes::find() {
  OctantList list;
  int first = 0;  // The first row whose octants are listed or to be listed.
  const auto makeSamples = [&](int end) {
    std::array<float*, SurfaceSamples::kColumns> to;
    for (int c = 0; c < SurfaceSamples::kColumns; ++c) to[c] = &mSamples.column[c][mSamples.count];
    list.makeSamples(mLevel, mTolerance, mK, to);
    mSamples.count += list.count;
    list.count = 0;
    for (; first < end; ++first)
      if (mRequested[first] != 0) mSamples.keepSupported(first);
  };
  for (int row = 0; row < kVoxels * kVoxels; ++row) {
    if (mRequested[row] == 0) continue;
    if (!list.hasRoomForRow()) makeSamples(row);
    listRow(row, list);
  }
  makeSamples(kVoxels * kVoxels);
  mFound = true;
}

void VoxelPlanes::listRow(int row, OctantList& list) {
  constexpr int kHalf = kLanes / 2;
  // Voxels that are requested mostly fit into half the lanes, from the first of them on.
  const unsigned requested = mRequested[row];
  const int low = std::countr_zero(requested), x = row / kVoxels, y = row % kVoxels;
  const bool fit = requested >> low < 1U << kHalf;
  const int lanes = fit ? kHalf : kLanes;
  const float* values = &mStencil.value[DistanceStencil::index(x - 1, y - 1, low - 1)];
  VoxelRow voxels;
  if (fit) {
    findSlopes<kHalf>(mLevel, values, mTolerance.jump, voxels);
    findOctants<kHalf>(mLevel, values, mTolerance.cutoff, voxels);
  } else {
    findSlopes<kLanes>(mLevel, values, mTolerance.jump, voxels);
    findOctants<kLanes>(mLevel, values, mTolerance.cutoff, voxels);
  }
  VoxelSamples::RowStarts& start = mSamples.start[row];
  const auto next = [&] { return mSamples.count + list.count; };
  std::fill_n(start.begin(), low, static_cast<std::uint16_t>(next()));
  for (int z = 0; z < lanes; z += kHalf) {
    std::uint64_t octants = 0;
    for (int k = 0; k < kHalf; ++k) octants |= static_cast<std::uint64_t>(voxels.octants[z + k]) << 8 * k;
    octants &= bytesOfBits(requested >> (low + z) & 0xFF);
    const std::uint64_t below = bitsBelowEachByte(octants);
    for (int k = 0; k < kHalf; ++k)
      start[low + z + k] = static_cast<std::uint16_t>(next() + int(below >> 8 * k & 0xFF));
    list.add(voxels, values, x << 8 | y << 4 | low, z, octants);
  }
  std::fill(start.begin() + low + lanes, start.end(), static_cast<std::uint16_t>(next()));
}

void VoxelPlanes::request(const Coord& cell) {
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      mRequested[kVoxels * (cell[0] + x) + cell[1] + y] |= static_cast<std::uint16_t>(0xF << cell[2]);
}

void VoxelPlanes::gather(const Coord& cell, SurfaceSamples& samples) {
  if (!mFound) find();
  const Vec3f center{float(cell[0]) + 0.5F, float(cell[1]) + 0.5F, float(cell[2]) + 0.5F};
  const VoxelSamples::RowStarts* const rowStarts = &mSamples.start[kVoxels * cell[0] + cell[1]];
  withSimd(mLevel, [&] {
    // Copies on the stack, which no store can change.
    const VoxelSamples::RowStarts* const rows = rowStarts;
    const VoxelSamples::Columns& from = mSamples.column;
    auto& to = samples.column;
    const int z = cell[2];
    int n = 0;
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 4; ++y) {
        const VoxelSamples::RowStarts& start = rows[kVoxels * x + y];
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
    // What lies behind the last sample must not spoil sums.
    for (auto& column : to) std::memset(&column[n], 0, kLanes * sizeof(float));
    samples.count = n;
    weighByDistance(center, mM, samples);
  });
}

}  // namespace pdc::detail
