#pragma once

#include <nlohmann/json.hpp>

#include "files/mesh_file.h"
#include "pdc/monitor.h"

namespace pdc {

/// Which things are no faults of a mesh.
struct CheckAllowances {
  bool boundary = false;  ///< Edges with one face.
  bool empty = false;     ///< A mesh without faces.
};

/// All that is known of a mesh that may be wrong: meshFacts(), and what its self-intersections are. Runs in parallel on
/// the calling thread's arena. \throws Error, Cancelled.
[[nodiscard]] nlohmann::ordered_json checkFacts(const MeshFile& file, const Monitor& monitor = {});

/// The names of those facts of checkFacts() that are faults.
[[nodiscard]] nlohmann::ordered_json faultsIn(const nlohmann::ordered_json& facts, const CheckAllowances& allowed);

}  // namespace pdc
