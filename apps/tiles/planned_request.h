#pragma once

#include <string>
#include <vector>

#include "pdc/io/mesh/mesh_writer.h"
#include "requests/mesh_request.h"

namespace pdc {

/// What a plan says of the mesh that its slabs make.
struct PlannedRequest {
  MeshRequest mesh;         ///< As if it had been given to `pdc mesh`, without an output.
  std::string space, unit;  ///< Of a volume's coordinates; empty where they are not known.
};

/// The text that a folder of slabs keeps. \param arguments the options given, as givenArguments() has them. \throws
/// Error if the input cannot be read.
[[nodiscard]] std::string plannedText(const std::filesystem::path& input, const std::vector<std::string>& arguments,
                                      const PlannedRequest& planned);

/// What a plan was asked for. \throws Error if its input is not what it was, or another version of pdc planned it.
[[nodiscard]] PlannedRequest plannedRequest(const std::string& text);

/// How the mesh of a request is written.
[[nodiscard]] MeshWriteOptions writeOptions(const PlannedRequest& planned);

}  // namespace pdc
