#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/frame_names.h"
#include "pdc/extract/contour.h"
#include "pdc/io/open_input.h"
#include "requests/grid_steps_request.h"
#include "terminal/length_option.h"

namespace pdc {

/// What the command line of `pdc mesh` says. What is empty was not said.
struct MeshRequest {
  std::filesystem::path input, output, json;
  std::optional<std::string> grid, sigmaGrid, weightGrid, adaptiveGrid;
  std::optional<bool> acceptNonFinite;
  std::optional<HermiteMode> hermite;
  std::optional<GridClass> gridClass;
  std::optional<InsideValues> inside;
  bool floodFill = false;
  std::optional<FrameRange> frames;
  std::vector<std::string> attributes;
  bool allAttributes = false;  ///< True for --attribute all.
  GridStepsRequest steps;
  VolumeReadOptions volume;
  std::optional<double> iso, sigmaNormal, voxelSize, shell;
  std::optional<int> resolution, threads;
  Placement placement = Placement::kCertified;
  std::optional<SuffixedLength> adaptive;
  bool triangles = false, open = false, normals = false, ascii = false;
  std::string unit{};           ///< Of the output; empty for the input's.
  std::string settings{};       ///< The options given, as text.
  bool isoFromOtsu = false;     ///< True for --iso otsu.
  bool sigmaFromData = false;   ///< True for --sigma-n auto.
  std::optional<Vec3d> origin;  ///< --origin X,Y,Z.
  bool originFromData = false;  ///< True for --origin auto.
  bool doublePrecision = false;
  std::size_t maxMemory = 0;  ///< Bytes; 0: what the machine has.
  bool confidence = false, rank = false, requireSurface = false, quiet = false;

  [[nodiscard]] InputKind kind() const { return volume.raw ? InputKind::kVolume : inputKind(input); }
  /// How to read the input, and what is done to a grid. \throws Error where steps name files that cannot be read.
  [[nodiscard]] InputOptions inputOptions() const;
  /// Whether the input is a mesh that is contoured itself, not its level set.
  [[nodiscard]] bool ofMesh() const { return kind() == InputKind::kMesh && !steps.meshToLevelSet; }
  /// Whether reading is long work that says how far it is: steps, a volume, or a mesh that is contoured to be moved.
  [[nodiscard]] bool readsInSteps() const {
    return !steps.empty() || kind() == InputKind::kVolume || shell.has_value();
  }
  /// What it asks vertices to have besides attributes.
  [[nodiscard]] std::vector<std::string> ownProperties() const;
  /// How to contour it; `otherSigma`, or σn from the data, holds where the command line does not say sigma.
  [[nodiscard]] ContourOptions contourOptions(std::optional<double> otherSigma) const;
};

/// "certified", "cell" or "free", as the command line and reports have it.
[[nodiscard]] std::string placementName(Placement placement);

/// Declares the options of `pdc mesh`; they are stored in `request` when the line is parsed.
void addMeshOptions(CLI::App& command, MeshRequest& request);

/// Declares those of `pdc plan`: the same, but for a folder in place of the output.
void addPlanOptions(CLI::App& command, MeshRequest& request, std::filesystem::path& folder);

/// Declares --iso.
CLI::Option* addIso(CLI::App& command, MeshRequest& request, const std::string& help);

/// Declares --placement.
CLI::Option* addPlacement(CLI::App& command, Placement& target, const std::string& help);

/// Declares --nan.
CLI::Option* addNonFinite(CLI::App& command, std::optional<bool>& target);

/// Declares --sigma-grid and --weight-grid.
void addNoiseGrids(CLI::App& command, MeshRequest& request, const std::string& group);

/// Declares --adaptive-grid.
void addAdaptiveGrid(CLI::App& command, MeshRequest& request, const std::string& group);

/// Declares --attribute.
void addAttribute(CLI::App& command, MeshRequest& request, const std::string& group);

/// Declares --class, --inside and --flood-fill.
void addGridMeaning(CLI::App& command, MeshRequest& request, const std::string& group);

/// \throws CLI::ValidationError for options that do not go with the kind of input, or a report that would replace the
/// input or the output; Error for an input that is of no kind, and for σ, weight and adaptive grids without a name or
/// with that of the grid.
void checkMeshRequest(const MeshRequest& request);

}  // namespace pdc
