#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pdc/grid/grid_steps.h"
#include "pdc/grid/mesh_to_level_set.h"

namespace pdc {

/// What the command lines of `pdc grid`, `pdc mesh` and `pdc sweep` say of steps on grids. What is empty was not said.
struct GridStepsRequest {
  std::optional<MeshToLevelSetOptions> meshToLevelSet;
  GridSteps steps;                                            ///< Without what has to be read from files.
  std::optional<double> voxelSize;                            ///< To resample to.
  std::string clipGrid;                                       ///< GRID, or FILE.vdb[:GRID].
  std::vector<std::pair<CombineKind, std::string>> combined;  ///< FILE.vdb[:GRID].

  [[nodiscard]] bool empty() const {
    return !meshToLevelSet && steps.empty() && !voxelSize && clipGrid.empty() && combined.empty();
  }
  /// Whether nothing but --offset was said, which meshes have, too.
  [[nodiscard]] bool isOffsetOnly() const;
};

/// Declares the options; they are stored in `request` when the line is parsed.
void addGridSteps(CLI::App& command, GridStepsRequest& request, const std::string& group);

/// Reads what the steps name. \param input the file that has the grid of a bare name. \param open leaves surfaces open
/// where they are clipped. \throws Error.
[[nodiscard]] GridSteps loadGridSteps(const GridStepsRequest& request, const std::filesystem::path& input,
                                      bool acceptNonFinite, bool open);

}  // namespace pdc
