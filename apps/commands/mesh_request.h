#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "pdc/extract/contour.h"

namespace pdc {

/// What the command line of `pdc mesh` says. Absent: not said.
struct MeshRequest {
  std::filesystem::path input, output, json;
  std::optional<std::string> grid, nan, hermite, sigmaGrid, weightGrid;
  std::optional<double> iso, sigmaNormal, voxelSize;
  std::optional<int> resolution, threads;
  std::string placement = "certified";
  bool triangles = false, open = false, normals = false, ascii = false;
  bool sigmaFromData = false;  ///< --sigma-n auto.
  bool confidence = false, rank = false, requireSurface = false, quiet = false;

  /// All of ContourOptions; `assumedSigma` holds where the command line does not say sigma.
  [[nodiscard]] ContourOptions contourOptions(double assumedSigma) const;
};

/// Declares the options of `pdc mesh`; they are stored in `request` when the line is parsed.
void addMeshOptions(CLI::App& command, MeshRequest& request);

/// Declares --sigma-grid and --weight-grid.
void addNoiseGrids(CLI::App& command, MeshRequest& request, const std::string& group);

/// \throws CLI::ValidationError for options that do not go with the kind of input, or a report that would replace the
/// input or the output; Error for an input that is neither grid nor scene.
void checkMeshRequest(const MeshRequest& request);

}  // namespace pdc
