#pragma once

#include <array>
#include <span>

#include "extract/vertices/cell_metric.h"
#include "pdc/math/sym_mat3.h"
#include "pdc/math/vec3.h"
#include "pdc/sample/feature_planes.h"
#include "sample/cell_edges.h"

namespace pdc::detail {

/// Hermite data of one surface patch in lattice units about the centre of its cell.
struct PatchSamples {
  static constexpr int kMax = kEdges;
  std::array<Vec3d, kMax> position;
  /// The row Mᵀn of each plane: |row · (x − position)| is the distance to it in voxels, measured in world space. Zero
  /// where there is no normal.
  std::array<Vec3d, kMax> row;
  int size = 0;
  /// What is known of each plane, if anything is: σn² besides the solver's, and its weight.
  bool noisy = false;
  std::array<double, kMax> variance, weight;
  /// Planes that take the place of those above, which then say only where the patch is; `point` from the centre too.
  std::span<const FeaturePlanes::Plane> features{};
  double featureSigma = 0;  ///< σn of them.
};

/// How far the normals of two crossings disagree with the chord between them, s² with
/// s = (n₁ + n₂) · (p₂ − p₁) / |p₂ − p₁|; 0 where they coincide. On a surface that bends evenly the mean of two normals
/// is perpendicular to the chord, to third order; beside a crease or with noise it is not.
template <typename T>
[[nodiscard]] T chordDisagreement(const Vec3<T>& row1, const Vec3<T>& row2, const Vec3<T>& chord, const SymMat3<T>& G) {
  const T across = dot(row1 + row2, chord), squared = quadraticForm(G, chord);
  return squared > 0 ? across * across / squared : T(0);
}

/// The mean of chordDisagreement() over all pairs of crossings, each with itself too.
[[nodiscard]] double chordResidual(const PatchSamples& samples, const CellMetric& metric);

/// Mean squared distance of a place from the planes that place the vertex, in voxels squared; planes from distances
/// count by their weights.
[[nodiscard]] double planeError(const PatchSamples& samples, const Vec3d& x);

}  // namespace pdc::detail
