#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "requests/mesh_request.h"

namespace pdc {

/// What one `pdc mesh` did, as far as the request does not say it. Seconds are wall-clock time.
struct MeshRun {
  ContourOptions options;
  ContourReport contour;
  double iso = 0;
  PlaneOrigin planeOrigin = PlaneOrigin::kGradient;
  double valueNoise = 0;                 ///< See Input.
  std::size_t crossingsWithoutData = 0;  ///< See Input.
  std::size_t verticesOnBox = 0;         ///< Where a scene's solid is cut off.
  std::optional<GridMeaning> meaning;    ///< See Input.
  std::optional<InputMeshFacts> mesh;    ///< See Input.
  std::vector<GridStepReport> steps;     ///< See Input.
  std::optional<InputVolume> volume;     ///< See Input.
  std::size_t vertices = 0, quads = 0, triangles = 0;
  std::size_t slabs = 1;  ///< Pieces it was contoured in; with several not all of `contour` is known.
  std::size_t bytesWritten = 0;
  Vec3d origin{};  ///< See Mesh::origin.
  nlohmann::ordered_json properties;
  double secondsRead = 0, secondsContour = 0, secondsWrite = 0, secondsTotal = 0;
  std::vector<std::string> warnings;
  std::string frame;  ///< Begins each warning that is printed: "frame 7: " of a sequence.
};

/// "auto" where it comes from the data, "inf", or a number.
[[nodiscard]] nlohmann::ordered_json sigmaNormalJson(const std::optional<double>& sigma);

/// What was done to a grid, one after the other.
[[nodiscard]] nlohmann::ordered_json toJson(const std::vector<GridStepReport>& steps);

[[nodiscard]] nlohmann::ordered_json toJson(const MeshRequest& request, const MeshRun& run);

}  // namespace pdc
