#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simplify/pair_contraction/vertex_marks.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// What isManifoldStar() says, in the time of a star's size, however large it is.
class ManifoldStars {
 public:
  explicit ManifoldStars(std::size_t vertices) : mNext(vertices), mPrevious(vertices) {}

  [[nodiscard]] bool isManifold(std::span<const StarCorner> star);
  /// The link condition: see CollapseChecks::keepsTopology(). \pre both stars, those of a and of b, are manifold, and
  /// an edge joins a and b.
  [[nodiscard]] bool keepsTopology(std::span<const StarCorner> starA, std::span<const StarCorner> starB,
                                   std::uint32_t a, std::uint32_t b);

 private:
  VertexMarks mNext, mPrevious;
};

/// Whether no face at a vertex degenerates or turns too far if it moves to `place`, but for those that `other` has,
/// too. \param from where it is. \param leastCosine of the angle by which a face may turn.
[[nodiscard]] bool keepsFaces(std::span<const StarCorner> star, const std::vector<Vec3d>& positions, const Vec3d& from,
                              const Vec3d& place, std::uint32_t other, double leastCosine);

}  // namespace pdc::detail
