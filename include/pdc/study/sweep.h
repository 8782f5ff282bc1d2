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

/// What is known about the surface that a mesh should be; any part may be missing.
struct SweepTruth {
  FieldPtr field{};                         ///< Zero on the surface.
  std::shared_ptr<const Mesh> reference{};  ///< Used where there is no field.
  std::vector<Vec3f> creases{};             ///< Points on its sharp edges; see creasePoints().
};

/// The measures of one mesh. Lengths are in voxels of its own lattice.
struct SweepStep {
  double value = 0;      ///< Of what is swept: σn, isovalue, or voxel size in world units.
  double voxelSize = 0;  ///< World units.
  double seconds = 0;    ///< Of contour() alone; sampling is in Sweep::secondsSample where it is shared.
  std::size_t vertices = 0, faces = 0;
  ContourReport contour{};
  std::optional<double> vertexRms{}, vertexMax{};  ///< Distance of the vertices to the true surface.
  std::optional<double> creaseRms{}, creaseMax{};  ///< Distance of the true creases' points to the mesh.
  double roughness = 0;                            ///< Of flat parts; see roughness().
  std::array<double, 3> minimumAngle{};            ///< Degrees: percentiles 1, 5 and 50 over the triangles.
  std::size_t selfIntersections = 0;               ///< Pairs of triangles.
  long long eulerNumber = 0;
};

struct Sweep {
  std::string parameter{};         ///< "sigma_n", "iso" or "voxel_size".
  std::vector<SweepStep> steps{};  ///< One per value, in the order given.
  std::vector<Mesh> meshes{};      ///< One per step.
  double secondsSample = 0;        ///< What the steps share: finding blocks, crossings and normals.
  double normalNoise = 0;          ///< Estimated from the Hermite data; see normalNoise(). 0 unless σn is swept.
  std::optional<std::size_t> recommended{};  ///< A step; only if σn is swept.
  std::string reason{};                      ///< Why it, or why none, in a sentence or two.
};

struct SweepOptions {
  ContourOptions contour{};  ///< sigmaNormal is ignored where it is swept.
  SweepTruth truth{};        ///< For sweepSigma.
};

/// Contours a source for several σn. It is sampled once; each mesh is the one that contour() makes with that σn, byte
/// for byte. Holds all meshes. Recommends a σn by recommendSigma(). \throws std::invalid_argument for no values or
/// those that contour() refuses; whatever contour() throws.
[[nodiscard]] Sweep sweepSigma(const HermiteSource& source, const std::vector<double>& sigmas,
                               const SweepOptions& options, const Monitor& monitor = {});

/// One source and what is true of it.
struct SweepInput {
  std::unique_ptr<const HermiteSource> source;
  SweepTruth truth;
};

/// Contours one source per value with the same options; `open` makes them, one at a time. \param parameter as in Sweep.
[[nodiscard]] Sweep sweepInputs(const std::string& parameter, const std::vector<double>& values,
                                const std::function<SweepInput(double)>& open, const SweepOptions& options,
                                const Monitor& monitor = {});

}  // namespace pdc
