#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "math/nearest_multiple.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Maps the positions of a mesh to the frame in which it is worked on, and back: mean edge lengths from the median of
/// its corners, where a few that lie far away do not cost the others their digits.
class LocalFrame {
 public:
  LocalFrame() = default;
  LocalFrame(const Mesh& mesh, const Buffer<Triangle>& faces) : mCenter(medianOf(mesh, faces)) {
    double sum = 0;
    for (const Triangle& t : faces)
      for (int k = 0; k < 3; ++k) {
        const Vec3d p = vecCast<double>(mesh.positions[t[k]]);
        sum += length(p - vecCast<double>(mesh.positions[t[(k + 1) % 3]]));
      }
    if (sum > 0) mUnit = sum / (3 * static_cast<double>(faces.size()));
  }

  /// What is mapped back has coordinates that are multiples of a step; 0 for any.
  void setStep(double step) { mStep = step; }

  /// The mean edge length.
  [[nodiscard]] double unit() const { return mUnit; }
  [[nodiscard]] Vec3d local(const Vec3f& p) const { return (vecCast<double>(p) - mCenter) * (1 / mUnit); }
  /// Finite: minima of vertices near the end of single precision may lie beyond it.
  [[nodiscard]] Vec3f world(const Vec3d& p) const {
    constexpr double kMost = std::numeric_limits<float>::max();
    Vec3d w = p * mUnit + mCenter;
    if (mStep > 0) w = nearestMultiple(w, mStep);
    for (int i = 0; i < 3; ++i) w[i] = std::clamp(w[i], -kMost, kMost);
    return vecCast<float>(w);
  }

 private:
  static Vec3d medianOf(const Mesh& mesh, const Buffer<Triangle>& faces) {
    constexpr std::size_t kSample = 4096;  // Any place amid the vertices does.
    const std::size_t step = 1 + faces.size() / kSample;
    Vec3d median{};
    std::vector<float> values;
    for (int axis = 0; axis < 3; ++axis) {
      values.clear();
      for (std::size_t i = 0; i < faces.size(); i += step) values.push_back(mesh.positions[faces[i][0]][axis]);
      if (values.empty()) break;
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      median[axis] = *middle;
    }
    return median;
  }

  Vec3d mCenter{};
  double mUnit = 1, mStep = 0;
};

}  // namespace pdc::detail
