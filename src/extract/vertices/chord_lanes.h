#pragma once

#include <algorithm>

#include "extract/vertices/crossing_planes.h"
#include "extract/vertices/patch_samples.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_lanes.h"

namespace pdc::detail {

/// The crossings of sixteen patches, one patch per lane, for what compares each with all others of its patch. The
/// functions must be compiled into a function of a SimdLevel.
class ChordLanes {
 public:
  void clear() { std::fill_n(mSize, kLanes, 0); }

  /// Replaces the crossings of a lane.
  void load(int lane, const SurfacePatch& patch, const EdgeIndex& edges, const CrossingPlanes& crossings) {
    int size = 0;
    forEachEdge(patch, edges, [&](int e, int number) {
      const Axis axis = kCellEdge[e].axis;
      const Coord low = cornerStep(kCellEdge[e].low);
      Vec3f place{float(low[0]), float(low[1]), float(low[2])};
      place[axis] += crossings.t(number);
      mPlace[size].set(lane, place);
      mRow[size++].set(lane, crossings.plane(number));
    });
    mSize[lane] = size;
  }

  /// chordResidual() of each lane; 0 of those without crossings. \param metric G of CellMetric.
  void residuals(const SymMat3<float>& metric, float* out) const {
    const SymMat3<float> G = metric;
    alignas(64) float sum[kLanes] = {};
    const int most = *std::max_element(mSize, mSize + kLanes);
    for (int i = 1; i < most; ++i)
      for (int k = 0; k < i; ++k)
        forEachLane([&, G, i](int lane) {
          const float s =
              chordDisagreement(mRow[i].get(lane), mRow[k].get(lane), mPlace[i].get(lane) - mPlace[k].get(lane), G);
          sum[lane] += i < mSize[lane] ? 2 * s : 0.0F;
        });
    forEachLane([&](int lane) {
      const auto size = static_cast<float>(std::max(mSize[lane], 1));
      out[lane] = sum[lane] / (size * size);
    });
  }

 private:
  alignas(64) std::int32_t mSize[kLanes] = {};
  Vec3Lanes<float> mPlace[PatchSamples::kMax] = {}, mRow[PatchSamples::kMax] = {};
};

}  // namespace pdc::detail
