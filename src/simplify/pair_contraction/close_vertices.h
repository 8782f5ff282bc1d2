#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// Finds vertices that are close to each other, by a grid of cells whose numbers are hashed.
class CloseVertices {
 public:
  /// \param positions finite where they are used; must outlive this. \param used by vertex, whether it is looked for.
  CloseVertices(const std::vector<Vec3d>& positions, const std::vector<std::uint8_t>& used, double distance);

  /// Adds the vertices with higher numbers that are closer to a vertex than the distance, in ascending order.
  void addAbove(std::uint32_t vertex, std::vector<std::uint32_t>& found) const;

 private:
  [[nodiscard]] Vec3d cellOf(const Vec3d& p) const;
  [[nodiscard]] std::size_t bucketOf(const Vec3d& cell) const;

  const std::vector<Vec3d>& mPositions;
  const double mDistance;
  double mInverseCell;
  std::vector<std::uint32_t> mFirst;     ///< By bucket, a power of two of them and one more.
  std::vector<std::uint32_t> mVertices;  ///< Of one bucket after the other, ascending.
};

}  // namespace pdc::detail
