#pragma once

#include <cstdint>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// The numbers of vertices of the pieces of a mesh that share no vertex, in the order of their first vertices; vertices
/// without a face count as pieces. Runs on the calling thread, as fast as the mesh is read a few times.
[[nodiscard]] std::vector<std::uint32_t> componentSizes(const Mesh& mesh);

}  // namespace pdc::detail
