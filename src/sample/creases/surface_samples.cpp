#include "sample/creases/surface_samples.h"

#include <limits>

namespace pdc::detail {

void VoxelSamples::keepSupported(int row) {
  constexpr int kMost = 3;
  RowStarts& starts = start[row];
  for (int v = 0; v < kVoxels; ++v)
    if (starts[v + 1] - starts[v] > kMost) keepMostSupported(kMost, starts[v], starts[v + 1]);
  const float* support = column[SurfaceSamples::kSupport].data();
  const int end = starts[kVoxels];
  int begin = starts[0];
  while (begin < end && support[begin] > 0) ++begin;
  if (begin == end) return;
  // From the first without support on samples move, without branches, which no processor would foresee.
  std::array<std::uint16_t, kVoxels * kOctants + 1> newPlace;
  int kept = begin;
  for (int i = begin; i < end; ++i) {
    newPlace[i - begin] = static_cast<std::uint16_t>(kept);
    for (auto& c : column) c[kept] = c[i];
    kept += support[i] > 0 ? 1 : 0;
  }
  newPlace[end - begin] = static_cast<std::uint16_t>(kept);
  for (int v = 0; v <= kVoxels; ++v)
    if (starts[v] >= begin) starts[v] = newPlace[starts[v] - begin];
}

/// Takes the support of all but `most` of a range of samples.
void VoxelSamples::keepMostSupported(int most, int begin, int end) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  float *support = column[SurfaceSamples::kSupport].data(), *fitWeight = column[SurfaceSamples::kFitWeight].data();
  int left = 0;
  for (int i = begin; i < end; ++i) left += support[i] > 0 ? 1 : 0;
  for (; left > most; --left) {
    int least = begin;
    float leastSupport = kNone;
    for (int i = begin; i < end; ++i) {
      const float s = support[i] > 0 ? support[i] : kNone;
      const bool less = s < leastSupport;
      least = less ? i : least;
      leastSupport = less ? s : leastSupport;
    }
    support[least] = fitWeight[least] = 0;
  }
}

}  // namespace pdc::detail
