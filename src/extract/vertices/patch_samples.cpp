#include "extract/vertices/patch_samples.h"

namespace pdc::detail {

double chordResidual(const PatchSamples& samples, const CellMetric& metric) {
  double sum = 0;
  for (int i = 0; i < samples.size; ++i)
    for (int k = 0; k < i; ++k)
      sum += 2 * chordDisagreement(samples.row[i], samples.row[k], samples.position[i] - samples.position[k], metric.G);
  return sum / (samples.size * samples.size);
}

double planeError(const PatchSamples& samples, const Vec3d& x) {
  double sum = 0;
  if (!samples.features.empty()) {
    for (const FeaturePlanes::Plane& p : samples.features) {
      const double distance = dot(vecCast<double>(p.row), x - vecCast<double>(p.point));
      sum += distance * distance;
    }
    return sum / static_cast<double>(samples.features.size());
  }
  for (int i = 0; i < samples.size; ++i) {
    const double distance = dot(samples.row[i], x - samples.position[i]);
    sum += distance * distance;
  }
  return sum / samples.size;
}

}  // namespace pdc::detail
