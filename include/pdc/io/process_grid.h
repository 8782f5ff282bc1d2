#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pdc/grid/grid_steps.h"
#include "pdc/grid/mesh_to_level_set.h"
#include "pdc/io/volume/volume_reader.h"
#include "pdc/monitor.h"

namespace pdc {

/// Which grid to take from where, and what to do to it.
struct ProcessGridOptions {
  std::string grid{};      ///< As readVdbGrid() takes it.
  SettleOptions settle{};  ///< The isovalue is that of the surface before the steps, or of what they make of a fog.
  GridSteps steps{};
  /// The file is a mesh instead, whose level set is taken.
  std::optional<MeshToLevelSetOptions> meshToLevelSet{};
  /// The file is a dense volume instead, which becomes a grid of float values.
  std::optional<VolumeReadOptions> volume{};
  bool isoFromOtsu = false;  ///< For a volume: its isovalue is otsuThreshold().
};

/// A grid from a file after the steps.
struct ProcessedGrid {
  GridVolume volume;
  std::vector<GridStepReport> steps;
  /// For a dense volume: what is known of its file; without values.
  std::optional<DenseVolume> volumeFile{};
  std::vector<std::string> warnings;  ///< Of how the grid was read, then of the steps; a line each.
};

/// Reads a grid and takes steps. Cannot be stopped while OpenVDB reads. \throws Error as readVdbGrid(), readMesh() or
/// readVolume(), settleGrid() and applyGridSteps() do, with the file's name before it; Cancelled.
[[nodiscard]] ProcessedGrid processGrid(const std::filesystem::path& path, const ProcessGridOptions& options,
                                        const Monitor& monitor = {});

}  // namespace pdc
