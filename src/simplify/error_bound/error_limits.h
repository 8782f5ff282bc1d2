#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// How far a decimated surface and the one given may be from each other: a distance, in world units, times the share
/// that each triangle given has of it.
class ErrorLimits {
 public:
  /// Coverage tells distances to a millionth. A share below that says no more, and lengths of 0 would have no parts
  /// that are small beside them.
  static constexpr float kLeastShare = 1e-6F;

  /// \param distance above 0. \param shares by triangle given, 0 or more; none if all have the whole distance.
  explicit ErrorLimits(double distance, std::vector<float> shares = {})
      : mDistance(distance), mShares(std::move(shares)) {
    for (float& share : mShares) share = std::max(share, kLeastShare);
    if (!mShares.empty()) mLargest = *std::max_element(mShares.begin(), mShares.end());
  }

  /// Whether all triangles have the same.
  [[nodiscard]] bool uniform() const { return mShares.empty(); }
  /// The whole distance, which no share changes.
  [[nodiscard]] double distance() const { return mDistance; }
  /// That of the triangle that has most.
  [[nodiscard]] double farthest() const { return mDistance * static_cast<double>(mLargest); }
  [[nodiscard]] double of(std::uint32_t triangle) const {
    return uniform() ? mDistance : mDistance * static_cast<double>(mShares[triangle]);
  }
  /// That of the triangle that has least of these.
  [[nodiscard]] double least(const std::vector<std::uint32_t>& triangles) const {
    double least = farthest();
    for (const std::uint32_t t : triangles) least = std::min(least, of(t));
    return least;
  }

 private:
  double mDistance;
  std::vector<float> mShares;
  float mLargest = 1;
};

/// The limits of some of a mesh's faces: the distance times the least of a property's numbers at the corners of each,
/// or the distance if the property's name is empty. \throws Error for a property that is missing, or that is negative
/// or not finite, naming the vertex.
[[nodiscard]] ErrorLimits errorLimits(const Mesh& mesh, const Buffer<Triangle>& faces, double distance,
                                      const std::string& property);

}  // namespace pdc::detail
