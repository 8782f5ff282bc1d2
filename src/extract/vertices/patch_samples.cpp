#include "extract/vertices/patch_samples.h"

namespace pdc::detail {

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
