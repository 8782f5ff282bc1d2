#include "extract/vertices/patch_samples.h"

#include "pdc/math/sym_mat3.h"

namespace pdc::detail {

double chordResidual(const PatchSamples& samples, const CellMetric& metric) {
  double sum = 0;
  for (int i = 0; i < samples.size; ++i)
    for (int k = 0; k < i; ++k) {
      const Vec3d chord = samples.position[i] - samples.position[k];
      const double across = dot(samples.row[i] + samples.row[k], chord), squared = quadraticForm(metric.G, chord);
      if (squared > 0) sum += 2 * across * across / squared;
    }
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
