#pragma once

#include <string>
#include <vector>

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Which faces a function can handle.
enum class FaceKinds { kTrianglesAndQuads, kAll };

/// Called where a mesh enters a public function, before anything reads past the end of a shorter array.
/// \param caller begins the error's text. \throws std::invalid_argument if the mesh's arrays do not fit together: see
/// Mesh; also if it has polygons and only triangles and quads can be handled.
void checkSizes(const Mesh& mesh, const char* caller, FaceKinds faces = FaceKinds::kTrianglesAndQuads);

/// One parallel pass over the faces. \throws Error if a face names a vertex that does not exist.
void checkIndices(const Mesh& mesh);

/// \throws Error that names the first vertex with a NaN or infinite coordinate.
void checkFinite(const Mesh& mesh);

/// The numbers of a property that has one for each vertex. \throws Error if there is none of that name, or if it has
/// several.
[[nodiscard]] std::vector<double> scalarNumbers(const Mesh& mesh, const std::string& name);

}  // namespace pdc::detail
