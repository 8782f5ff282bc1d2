#pragma once

#include <cstdint>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"

namespace pdc::detail {

struct FitRule {
  const std::vector<std::uint32_t>& became;  ///< By vertex given, that into which it was collapsed, or itself.
  double leastCosine;                        ///< See CollapseChecks.
  double sigmaNormal;  ///< Noise of the normals given: where there is any, vertices stay nearer to where they are.
  bool sigmaNormalOfVertices;  ///< See DecimationRule.
  bool sound;                  ///< See DecimationRule.
};

/// Moves the vertices of a decimated surface to where its faces lie nearest to the surface given, in the least squares
/// of the distances along their normals. Vertices that are locked or at the boundary stay, and so do those whose faces
/// would turn too far. Runs in parallel; the result does not depend on the number of threads. \throws Cancelled.
void fitSurface(DecimatedSurface& surface, const GivenSurface& given, const FitRule& rule, const Monitor& monitor);

}  // namespace pdc::detail
