#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/field.h"
#include "pdc/io/process_grid.h"
#include "pdc/io/volume/volume_reader.h"
#include "pdc/sample/hermite_source.h"
#include "pdc/sample/vdb/grid_source.h"

namespace pdc {

/// What a file holds, by its suffix in upper or lower case: .vdb is a grid, .yaml and .yml are scenes, .ply, .obj, .off
/// and .stl, also compressed (.ply.gz), are meshes, isVolumeFile() knows volumes.
enum class InputKind { kGrid, kScene, kVolume, kMesh, kOther };

/// Looks at the name alone; the file need not exist.
[[nodiscard]] InputKind inputKind(const std::filesystem::path& path);

/// Voxels along the longest side of a mesh's box where nothing is said.
inline constexpr int kMeshResolution = 128;

/// The σn of meshes where nothing is said: their normals are exact, but where triangles are smaller than voxels a patch
/// sees few of them. Creases of parts are then exact to 0.001 voxel.
inline constexpr double kMeshSigmaNormal = 0.02;

/// How to read an input. What is empty, false or kAuto is not asked for, and goes with every kind of input.
struct InputOptions {
  /// Finite. Empty: 0 for level sets, 0.5 for fog volumes, what DenseSource and a scene say.
  std::optional<double> iso{};
  bool open = false;             ///< The surface ends where the data ends, instead of being closed.
  bool acceptNonFinite = false;  ///< NaN and infinite values are outside; see GridSourceOptions, FieldSourceOptions.

  // For grids and, up to `inside`, for dense volumes.
  HermiteMode hermite = HermiteMode::kAuto;
  std::optional<GridClass> gridClass{};    ///< Empty: the grid's, or what its values say; see readMeaning().
  std::optional<InsideValues> inside{};    ///< Empty: decided from the grid.
  std::optional<std::string> grid{};       ///< As readVdbGrid() takes it. Empty: the only grid that can be contoured.
  bool floodFill = false;                  ///< See GridSourceOptions.
  std::optional<std::string> sigmaGrid{};  ///< A grid of the same file: standard deviation of each value, in its units.
  std::optional<std::string> weightGrid{};  ///< A grid of the same file: how much each value counts beside others.
  /// Further grids of the same file, of any transform, as readVdbAttribute() takes them, in this order.
  std::vector<std::string> attributes{};
  bool allAttributes = false;  ///< All further grids that can be sampled, in file order; then `attributes` is empty.
  std::optional<std::string> adaptiveGrid{};  ///< A float or double grid of the same file, of any transform.

  GridSteps steps{};  ///< What is done to the grid or volume first; excludes σ and weight grids.
  /// The file is a mesh instead, whose level set is taken.
  std::optional<MeshToLevelSetOptions> meshToLevelSet{};

  // For dense volumes only.
  VolumeReadOptions volume{};  ///< With `raw` any file is a volume.
  bool isoFromOtsu = false;    ///< The isovalue is otsuThreshold(); excludes `iso`.

  // For scenes and meshes only; at most one of them. Neither: what the scene says, or kMeshResolution.
  std::optional<double> voxelSize{};  ///< World units, > 0.
  std::optional<int> resolution{};    ///< Voxels along the longest side of the box, 1 to kMaxVoxelsPerAxis.

  // For meshes only.
  std::optional<double> offset{};  ///< The surface goes outwards by this, or inwards below 0; world units, finite.
  /// Only a wall of this thickness is left, inwards from the surface; world units, > 0.
  std::optional<double> shell{};
};

/// Where the planes of an input come from.
enum class PlaneOrigin {
  kGradient,  ///< A grid's gradients at the crossings.
  kDistance,  ///< Beside creases, a grid's distances; see GridSource.
  kFunction,  ///< The gradients of a scene's function.
  kTriangle,  ///< The triangles of a mesh.
};

/// "gradient", "distance", "function" or "triangle", as reports have it.
[[nodiscard]] std::string_view planeOriginName(PlaneOrigin origin);

/// A grid whose values the mesh's vertices may have; see gridAttribute().
struct InputAttribute {
  std::string name;
  openvdb::GridBase::ConstPtr grid;  ///< Not null.
};

/// What is known of the file of a dense volume; see DenseVolume.
struct InputVolume {
  std::string format, encoding, space, unit, orientation;
  std::array<std::int64_t, 3> size{};
};

/// How a mesh is read that is an input.
struct InputMeshFacts {
  std::size_t triangles = 0, openEdges = 0;  ///< See MeshSourceFacts.
  double voxelSize = 0;                      ///< World units.
};

/// An input that is ready to be contoured.
struct Input {
  std::unique_ptr<const HermiteSource> source;  ///< Owns what it reads from; never null.
  double iso = 0;                               ///< In the grid's or the function's own units.
  std::optional<double> sigmaNormal{};  ///< σn (no unit, >= 0 or infinite) of a scene that says one, or of a mesh.
  FieldPtr field{};  ///< For scenes and meshes: zero on the surface that the result should have. Null for a grid.
  std::function<double(const Vec3d&)> adaptiveScale{};  ///< See ContourOptions; the adaptive grid's, if there is one.
  std::vector<InputAttribute> attributes{};             ///< As asked for.
  std::optional<Box> cut{};  ///< Where a scene's solid is cut off and closed; empty for a grid and an open surface.
  PlaneOrigin planeOrigin = PlaneOrigin::kGradient;
  double valueNoise = 0;         ///< Standard deviation of the values' noise in voxels where it was estimated; else 0.
  std::size_t refusedNoise = 0;  ///< Values of the σ and weight grids that are negative or not finite; they count as 0.
  std::size_t crossingsWithoutData = 0;  ///< See GridSource.
  std::optional<GridMeaning> meaning{};  ///< How a grid is read, and why. Empty for a scene.
  std::optional<InputMeshFacts> mesh{};  ///< For a mesh only.
  std::vector<GridStepReport> steps{};   ///< What was done to the grid.
  std::optional<InputVolume> volume{};   ///< Empty for other inputs than dense volumes.
  /// Where the data may mean something else than it was taken for or makes a poor surface: a line each, which names the
  /// remedy by the program's option.
  std::vector<std::string> warnings{};
  /// Says in a clause why a contour of this source is empty. Reads a grid's file again. \throws Error if that fails.
  std::function<std::string()> whyEmpty;
};

/// Reads a .vdb grid, a dense volume, a scene or a mesh and makes the source that `pdc mesh` contours. A grid is wholly
/// in memory afterwards, a volume as far as it is compressed; OpenVDB is initialised on the way. The monitor is that of
/// the steps; nothing can be stopped while OpenVDB reads. \throws Error for another kind of file, options that go with
/// another kind of input, both a voxel size and a resolution, a σ, weight or adaptive grid or an attribute without a
/// name or that is the grid itself, a σ or weight grid with steps, an attribute that is named twice; whatever
/// processGrid(), readVdbGrid(), readVdbAttribute(), gridFunction(), GridSource, readVolume(), otsuThreshold(),
/// DenseSource, readScene(), readMesh() and FieldSource throw.
[[nodiscard]] Input openInput(const std::filesystem::path& path, const InputOptions& options = {},
                              const Monitor& monitor = {});

/// The kind that the options make of a file.
[[nodiscard]] InputKind inputKind(const std::filesystem::path& path, const InputOptions& options);

/// What processGrid() takes of these options for this file.
[[nodiscard]] ProcessGridOptions processOptions(const std::filesystem::path& path, const InputOptions& options);

}  // namespace pdc
