#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "pdc/study/sweep.h"
#include "requests/mesh_request.h"

namespace pdc {

/// What the command line of `pdc sweep` says.
struct SweepRequest {
  MeshRequest mesh;  ///< Input, placement and so on; what is swept is set for each value.
  std::filesystem::path folder, reference;
  std::vector<double> sigmas, isos, voxelSizes, adaptive;  ///< At most one has several values.
  bool adaptiveInVoxels = false;                           ///< Else in world units.
  Vec3d towardsViewer{1, -1, 1};
  bool meshes = false;

  /// The one with several values, or σn.
  [[nodiscard]] SweepParameter parameter() const;
  [[nodiscard]] const std::vector<double>& values() const;
};

void addSweepOptions(CLI::App& command, SweepRequest& request);

/// Takes over the values that are not swept and fills in what is not said. \throws what checkMeshRequest does, and
/// CLI::ValidationError if two options have several values.
void settleSweepRequest(SweepRequest& request);

/// The program's name and these arguments as a shell takes them.
[[nodiscard]] std::string commandLine(const std::vector<std::string>& arguments);

}  // namespace pdc
