#pragma once

#include <cstdint>
#include <vector>

#include "simplify/vertex_quadrics.h"

namespace pdc::detail {

/// Whether edges may be collapsed.
class CollapseChecks {
 public:
  /// \param leastCosine of the angle by which a face may turn. All
  /// must outlive this.
  CollapseChecks(const VertexStars& stars, const std::vector<Vec3d>& positions, const Buffer<FaceArea>& areas,
                 double leastCosine)
      : mStars(stars), mPositions(positions), mAreas(areas), mLeastCosine(leastCosine) {}

  /// The link condition (Dey, Edelsbrunner, Guha & Nekhayev 1999): whether the surface stays a manifold of the same
  /// topology if the edge from a to b, both of which have manifold stars, becomes one vertex.
  [[nodiscard]] bool keepsTopology(std::uint32_t a, std::uint32_t b) const;
  /// Whether no face degenerates or turns too far if a and b are both moved to `place`.
  [[nodiscard]] bool keepsFaces(std::uint32_t a, std::uint32_t b, const Vec3d& place) const {
    return keepsFacesOf(a, b, place) && keepsFacesOf(b, a, place);
  }

 private:
  [[nodiscard]] bool keepsFacesOf(std::uint32_t moved, std::uint32_t other, const Vec3d& place) const;

  const VertexStars& mStars;
  const std::vector<Vec3d>& mPositions;
  const Buffer<FaceArea>& mAreas;
  const double mLeastCosine;
};

}  // namespace pdc::detail
