#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pdc/io/open_input.h"
#include "pdc/mesh/mesh.h"

namespace pdc {

/// What mends a mesh that is not as good as it could be, in the words of whoever asked for it.
struct MeshRemedies {
  std::string precision = "--origin auto or --double keeps what is lost";
  std::string specks = "an --iso farther from the noise or a smoothed input has fewer";
};

/// What the user of a mesh should know of, a line each: coordinates for which single precision is coarser than the
/// vertices were placed, and thousands of closed surfaces about a lattice point or few, as noise makes them.
/// \throws Error for coordinates beyond single precision.
[[nodiscard]] std::vector<std::string> meshWarnings(const Input& input, const Mesh& mesh, const MeshRemedies& remedies);

/// The number of vertices of the walls that close a scene's solid where its box cuts it off.
[[nodiscard]] std::size_t verticesOnBox(const Input& input, const Mesh& mesh);

}  // namespace pdc
