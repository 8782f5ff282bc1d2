#pragma once

#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// Called where a mesh enters a public function, before anything reads past the end of a shorter array.
/// \param caller begins the error's text. \throws std::invalid_argument if the mesh's arrays do not fit together: see
/// Mesh.
void checkSizes(const Mesh& mesh, const char* caller);

/// One parallel pass over the faces. \throws Error if a face names a vertex that does not exist.
void checkIndices(const Mesh& mesh);

}  // namespace pdc::detail
