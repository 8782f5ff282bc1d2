#pragma once

#include <cstdint>
#include <vector>

#include "simplify/vertex_quadrics.h"

namespace pdc::detail {

/// Where the vertex that two ends of an edge become would go, and at what cost.
struct EdgeCollapse {
  Vec3d place;
  double cost;   ///< What the quadrics of both ends are there, 0 or more.
  bool limited;  ///< Whether the minimum was too far away.
};

/// A collapse that is to be done: of the edge between a and b into a.
struct ChosenCollapse {
  std::uint32_t a, b;
  EdgeCollapse to;
};

/// Places vertices of collapsed edges.
class CollapseRule {
 public:
  /// All arrays are by vertex and must outlive this.
  CollapseRule(const std::vector<Vec3d>& positions, const Buffer<VertexQuadric>& quadrics,
               const std::vector<std::uint8_t>& locked)
      : mPositions(positions), mQuadrics(quadrics), mLocked(locked) {}

  bool classical = false;  ///< Quadrics may have no single minimum.
  bool subset = false;     ///< See CollapsePlacement.

  /// Collapses the edge from a to b. \param between sum of the vectors of the faces at the edge. \param keepsVolume
  /// whether the vertex is drawn to where the enclosed volume stays: where no edge joins a and b, it may not be
  /// enclosed.
  [[nodiscard]] EdgeCollapse collapse(std::uint32_t a, std::uint32_t b, const Vec3d& between,
                                      bool keepsVolume = true) const;

  /// Whether EdgeLanes finds the cost of an edge.
  [[nodiscard]] bool inLanes(std::uint32_t a, std::uint32_t b) const {
    return !classical && !subset && mLocked[a] == 0 && mLocked[b] == 0;
  }
  [[nodiscard]] const Vec3d& position(std::uint32_t v) const { return mPositions[v]; }
  [[nodiscard]] const VertexQuadric& quadric(std::uint32_t v) const { return mQuadrics[v]; }

 private:
  const std::vector<Vec3d>& mPositions;
  const Buffer<VertexQuadric>& mQuadrics;
  const std::vector<std::uint8_t>& mLocked;
};

}  // namespace pdc::detail
