#pragma once

#include <cstddef>

#include "parallel/block_progress.h"
#include "pdc/mesh/buffer.h"
#include "pdc/subdivide/subdivide.h"
#include "subdivide/half_edges.h"

namespace pdc::detail {

/// What the limit surface is at the vertices of a mesh.
template <typename Value>
struct LimitSurface {
  Buffer<Value> vertices;
  Buffer<Vec3f> normals;                               ///< Empty unless asked for; 0 where there is no tangent plane.
  Buffer<float> meanCurvature{}, gaussianCurvature{};  ///< Likewise.
  std::size_t estimatedCurvatures = 0;                 ///< See SubdivideReport.
};

/// Gaussians have the linear scheme's limit in the dual space, and the map back takes its derivatives to those of the
/// surface (Preiner et al. 2019, appendix B). \param mesh triangles, or quads, by the scheme. \param progress advances
/// by the number of vertices. \throws Cancelled.
template <typename Value>
[[nodiscard]] LimitSurface<Value> limitSurface(const HalfEdges& mesh, const Buffer<Value>& vertices,
                                               const SubdivideOptions& options, BlockProgress& progress);

}  // namespace pdc::detail
