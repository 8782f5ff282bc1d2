#pragma once

#include <string>
#include <vector>

#include "io/parse/narrowing.h"
#include "pdc/mesh/mesh.h"

namespace pdc::detail {

/// What a reader of one format makes of a file's bytes. Readers subtract a shift from all coordinates before they
/// narrow them, and add it to the origin that the file says: the first time it is zero, and where `narrowing` then
/// shows that single precision does not serve, the bytes are read again.
struct ParsedMesh {
  Mesh mesh;
  Narrowing narrowing;                ///< What narrowing does to the coordinates of the file.
  bool splitsQuads = false;           ///< Whether the file's quads are known to be split at their first corners.
  std::vector<std::string> warnings;  ///< What was not read or is odd.
};

}  // namespace pdc::detail
