#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/field.h"

namespace pdc {

/// What a sweep has several values of.
enum class SweepParameter {
  kSigmaNormal,  ///< σn; no unit.
  kIso,          ///< The isovalue, in the units of the grid or the function.
  kVoxelSize,    ///< The edge of a cell, in world units.
  kAdaptive,     ///< ContourOptions::adaptive, in voxels; 0 for none.
};

/// How files and people call a parameter.
struct SweepParameterNames {
  const char* key;    ///< "sigma_n", "iso", "voxel_size" or "adaptive", as in files.
  const char* label;  ///< "σn", "isovalue", "voxel size" or "adaptive distance", in UTF-8.
};

[[nodiscard]] SweepParameterNames namesOf(SweepParameter parameter);

/// What is known about the surface that a mesh should be; any part may be missing.
struct SweepTruth {
  FieldPtr field{};                         ///< Zero on the surface, with gradients there; world units.
  std::shared_ptr<const Mesh> reference{};  ///< Used where there is no field. World units; needs a face.
  std::vector<Vec3f> creases{};             ///< Points on the sharp edges, world units; see creasePoints().
};

/// The measures of one mesh. Lengths are in voxels of its own lattice. Without a surface all but the first three are 0
/// or empty.
struct SweepStep {
  double value = 0;      ///< What the swept parameter was; see SweepParameter for its unit.
  double voxelSize = 0;  ///< World units; see LatticeMap::voxelSize().
  double seconds = 0;    ///< Wall-clock time of contour(); sampling is in Sweep::secondsSample where it is shared.
  std::size_t vertices = 0, faces = 0;
  std::size_t triangles = 0;  ///< Faces, each quad counted twice.
  ContourReport contour{};
  /// Distance of the vertices to the true surface, >= 0. To a field it is |f| / |grad f|, so exact to first order.
  /// Empty without a truth, and if no distance is finite.
  std::optional<double> vertexRms{}, vertexMax{};
  /// The largest distance of a vertex of either mesh to the other, this one and the one without adaptivity. Empty if
  /// there is none.
  std::optional<double> adaptedMax{};
  /// Distance of the true creases' points to the mesh, >= 0. Empty without creases.
  std::optional<double> creaseRms{}, creaseMax{};
  double roughness = 0;                  ///< How rough flat parts are, >= 0; see roughness().
  std::array<double, 3> minimumAngle{};  ///< Degrees, 0 to 60: percentiles 1, 5 and 50 over the triangles' smallest.
  std::size_t selfIntersections = 0;     ///< Pairs of triangles; counted up to SelfIntersectionOptions::maxPairs.
  long long eulerNumber = 0;             ///< V - E + F.
};

struct Sweep {
  SweepParameter parameter = SweepParameter::kSigmaNormal;
  std::vector<SweepStep> steps{};  ///< One per value, in the order given.
  std::vector<Mesh> meshes{};      ///< One per step.
  double secondsSample = 0;        ///< What the steps share: finding blocks, crossings and normals. 0 if nothing.
  double normalNoise = 0;          ///< Estimated from the Hermite data; see normalNoise(). 0 unless σn is swept.
  std::optional<std::size_t> recommended{};  ///< The number of a step. Empty unless σn is swept, and for flat curves.
  std::string reason{};                      ///< Why that step, or why none: a sentence or two, UTF-8.
};

struct SweepOptions {
  ContourOptions contour{};          ///< What is swept of it is ignored. `threads` holds for measuring too.
  SweepTruth truth{};                ///< Not used by sweepInputs().
  std::optional<double> adaptive{};  ///< ContourOptions::adaptive in voxels of each lattice; then `contour` has none.
};

/// Contours a source for several σn (no unit, >= 0 or infinite), and measures the meshes. The source is sampled once;
/// each mesh is the one that contour() makes with that σn, byte for byte. Holds all meshes at once.
///
/// Recommends the σn whose mesh is nearest to the truth: by the root of the summed squares of vertexRms and creaseRms;
/// none if the largest and the smallest of these differ by less than 5 %. Without a truth, the σn nearest to
/// `normalNoise` by its logarithm, which is an estimate.
///
/// `monitor` hears the share of the whole sweep, which never falls and ends at 1, with the name of the stage at hand. A
/// set stop flag ends any part of it within about a block's time, but for the building of search trees.
/// \throws std::invalid_argument for no values or those that contour() refuses; Error as distances() for a reference
/// without a face; whatever contour() throws.
[[nodiscard]] Sweep sweepSigma(const HermiteSource& source, const std::vector<double>& sigmas,
                               const SweepOptions& options, const Monitor& monitor = {});

/// Contours a source adaptively within several distances (voxels, >= 0 and finite; 0 is without adaptivity), and
/// measures the meshes; recommends nothing. The source is sampled once. Roughness is that of each mesh's own flat
/// parts. Otherwise as sweepSigma().
[[nodiscard]] Sweep sweepAdaptive(const HermiteSource& source, const std::vector<double>& distances,
                                  const SweepOptions& options, const Monitor& monitor = {});

/// One source and what is true of it.
struct SweepInput {
  std::unique_ptr<const HermiteSource> source;  ///< Not null.
  SweepTruth truth;
};

/// Contours one source per value with the same options, and measures the meshes; recommends nothing. `open` makes the
/// sources, one at a time, on the calling thread or on one that works for it. The monitor is used as by sweepSigma(),
/// and looked at before and after each call of `open`. \throws std::invalid_argument for no values, or for what
/// sweepSigma() and sweepAdaptive() sweep; whatever `open`, contour() and distances() throw.
[[nodiscard]] Sweep sweepInputs(SweepParameter parameter, const std::vector<double>& values,
                                const std::function<SweepInput(double)>& open, const SweepOptions& options,
                                const Monitor& monitor = {});

}  // namespace pdc
