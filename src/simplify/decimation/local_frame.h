#pragma once

#include <algorithm>
#include <cstddef>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Maps the positions of a mesh to the frame in which it is decimated, and back: mean edge lengths from the middle of
/// its box.
class LocalFrame {
 public:
  LocalFrame() = default;
  LocalFrame(const Mesh& mesh, const Buffer<Triangle>& faces) {
    double sum = 0;
    Vec3d low{}, high{};
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Vec3d p = vecCast<double>(mesh.positions[faces[i][k]]);
        sum += length(p - vecCast<double>(mesh.positions[faces[i][(k + 1) % 3]]));
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = i + k == 0 ? p[axis] : std::min(low[axis], p[axis]);
          high[axis] = i + k == 0 ? p[axis] : std::max(high[axis], p[axis]);
        }
      }
    mCenter = (low + high) * 0.5;
    if (sum > 0) mUnit = sum / (3 * static_cast<double>(faces.size()));
  }

  /// The mean edge length.
  [[nodiscard]] double unit() const { return mUnit; }
  [[nodiscard]] Vec3d local(const Vec3f& p) const { return (vecCast<double>(p) - mCenter) * (1 / mUnit); }
  [[nodiscard]] Vec3f world(const Vec3d& p) const { return vecCast<float>(p * mUnit + mCenter); }

 private:
  Vec3d mCenter{};
  double mUnit = 1;
};

}  // namespace pdc::detail
