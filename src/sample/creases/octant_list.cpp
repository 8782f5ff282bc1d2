#include "sample/creases/octant_list.h"

#include <bit>
#include <cmath>

#include "math/lane_loops.h"

namespace pdc::detail {

void OctantList::add(const VoxelRow& row, const float* first, int rowStart, int z, std::uint64_t octants) {
  const float *slopes = &row.slope[z], *residuals = &row.residual[z];
  first += z;
  const int firstVoxel = rowStart + z;
  int n = count;
  for (; octants != 0; octants &= octants - 1, ++n) {
    const auto bit = static_cast<unsigned>(std::countr_zero(octants)), v = bit / kOctants, octant = bit % kOctants;
    slope[0][n] = slopes[v + octant % 2 * kLanes];
    slope[1][n] = slopes[v + (2 + octant / 2 % 2) * kLanes];
    slope[2][n] = slopes[v + (4 + octant / 4) * kLanes];
    residual[n] = residuals[v + octant * kLanes];
    value[n] = first[v];
    voxel[n] = firstVoxel + static_cast<int>(v);
  }
  count = n;
}

void OctantList::makeSamples(SimdLevel level, const PlaneTolerance& tolerance, const Mat3f& K,
                             const std::array<float*, SurfaceSamples::kColumns>& to) const {
  forEachBatch(level, batchCount(static_cast<std::size_t>(count)), [&](std::size_t block) {
    const std::size_t begin = block * kLanes;
    const float *sx = &slope[0][begin], *sy = &slope[1][begin], *sz = &slope[2][begin], *residualOf = &residual[begin],
                *valueOf = &value[begin];
    const std::int32_t* voxelOf = &voxel[begin];
    float *normalX = to[SurfaceSamples::kNormalX] + begin, *normalY = to[SurfaceSamples::kNormalY] + begin,
          *normalZ = to[SurfaceSamples::kNormalZ] + begin, *footX = to[SurfaceSamples::kFootX] + begin,
          *footY = to[SurfaceSamples::kFootY] + begin, *footZ = to[SurfaceSamples::kFootZ] + begin,
          *supportOf = to[SurfaceSamples::kSupport] + begin, *fitWeightOf = to[SurfaceSamples::kFitWeight] + begin;
    forEachLane([&](int lane) {
      const float rx = sx[lane], ry = sy[lane], rz = sz[lane];
      const float gx = rx * K.row[0].x + ry * K.row[1].x + rz * K.row[2].x,
                  gy = rx * K.row[0].y + ry * K.row[1].y + rz * K.row[2].y,
                  gz = rx * K.row[0].z + ry * K.row[1].z + rz * K.row[2].z;
      const float l = std::sqrt(gx * gx + gy * gy + gz * gz), off = std::abs(l - 1), r = residualOf[lane];
      const float error = r < off ? off : r, e = error / tolerance.cutoff, biweight = 1 - e * e,
                  excess = error / tolerance.scale, damping = 1 + excess * excess, inverseLength = 1 / l;
      const bool within = error < tolerance.cutoff;
      const float support = within ? biweight * biweight : 0.0F, phi = valueOf[lane];
      const float nx = within ? gx * inverseLength : 0.0F, ny = within ? gy * inverseLength : 0.0F,
                  nz = within ? gz * inverseLength : 0.0F;
      const std::int32_t v = voxelOf[lane];
      const auto x = static_cast<float>((v >> 8) - 1), y = static_cast<float>((v >> 4 & 15) - 1),
                 z = static_cast<float>((v & 15) - 1);
      normalX[lane] = nx;
      normalY[lane] = ny;
      normalZ[lane] = nz;
      footX[lane] = x - (nx * K.row[0].x + ny * K.row[0].y + nz * K.row[0].z) * phi;
      footY[lane] = y - (nx * K.row[1].x + ny * K.row[1].y + nz * K.row[1].z) * phi;
      footZ[lane] = z - (nx * K.row[2].x + ny * K.row[2].y + nz * K.row[2].z) * phi;
      supportOf[lane] = support;
      fitWeightOf[lane] = support / (damping * damping);
    });
  });
}

}  // namespace pdc::detail
