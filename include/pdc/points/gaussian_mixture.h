#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pdc/math/sym_mat3.h"
#include "pdc/math/vec3.h"
#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"
#include "pdc/points/point_cloud.h"

namespace pdc {

/// Gaussians, weighted, whose sum says how likely a point of the surface is anywhere. One entry of each list per
/// Gaussian. A passive value.
struct GaussianMixture {
  Buffer<Vec3d> means;                  ///< World units.
  Buffer<SymMat3<double>> covariances;  ///< Positive definite; world units squared.
  Buffer<double> weights;               ///< Above 0; their sum is 1.
  Buffer<Vec3f> normals;                ///< Empty, or the mean direction of the points' normals; zero if unknown.
  Buffer<Vec3f> colours;                ///< Empty, or the mean of the points' red, green and blue, 0 to 255.

  [[nodiscard]] std::size_t size() const { return means.size(); }
};

struct MixtureOptions {
  /// Standard deviation σ0 of the Gaussian about each point, in world units, above 0 and finite; that of the point, if
  /// it has one, is added in squares. Not set: the side of the square that a point has of the surface, by the median
  /// distance to the eighth nearest point (see MixtureReport::sigma0). Larger ones give fewer Gaussians and a smoother
  /// surface.
  std::optional<double> sigma0{};
  /// A Gaussian is merged into another if their Kullback-Leibler divergence is at most α²/2; above 0; infinity merges
  /// whatever there is, in time and memory of the square of their number. 1.5 to 2.5 in the paper.
  double alpha = 2;
  int levels = 2;      ///< At most how many times Gaussians are merged, 0 to 100; less if none are left to merge.
  int iterations = 1;  ///< Steps of expectation and maximisation within a level, 1 to 1000.
};

struct MixtureLevelReport {
  std::size_t before = 0, after = 0;  ///< Gaussians.
  std::size_t parents = 0;            ///< Those that others were merged into.
  std::size_t kept = 0;               ///< Those that no parent was near enough to: they stay as they are.
  std::size_t clamped = 0;            ///< Covariances whose least eigenvalue was raised to 1e-6 of the largest.
  /// The logarithm of the likelihood of what was merged, Σi log Σs ws L(Θs|Θi), before each iteration. Within a level
  /// it never falls while the weights of what is merged are equal, as they are in the first level where no points
  /// coincide, but for clamping.
  std::vector<double> logLikelihood{};
};

struct MixtureReport {
  std::size_t points = 0,
              duplicates = 0;  ///< Duplicates lie where another point does; they count as one of its weight.
  double sigma0 = 0;           ///< In use.
  std::vector<MixtureLevelReport> levels{};
};

/// Turns points into a few Gaussians: hierarchical expectation maximisation with geometric regularisation (Preiner et
/// al. 2019, appendix A; Vasconcelos & Lippman 1999). Each level takes a third of the Gaussians as parents, chosen by a
/// hash of their means, and merges the others into those that are near enough, each by its shares. Gaussians whose
/// normals point to opposite sides are never merged, so that sides of thin sheets stay apart where normals are known.
///
/// \returns Gaussians in a spatial order. The result depends neither on the number of threads nor on the order of the
/// points, byte for byte. \throws as checkPointCloud() does; std::invalid_argument for options out of range; Error if
/// σ0 is too large beside the spacing of the points for the memory, and if none is given and all points coincide;
/// Cancelled. Progress: "mixture". Memory: some 250 bytes per point and 12 for each pair of Gaussians that are near
/// enough, which are about 10 per point for α = 2 and σ0 as by default.
[[nodiscard]] GaussianMixture gaussianMixture(const PointCloud& cloud, const MixtureOptions& options = {},
                                              MixtureReport* report = nullptr, const Monitor& monitor = {});

/// A mixture as the vertices of a mesh without faces, for files: covariances as vertex_covariances.h has them, the
/// property "weight" (double), normals, and colours as "red", "green" and "blue" (uint8).
[[nodiscard]] Mesh mixtureMesh(const GaussianMixture& mixture);

/// What mixtureMesh() makes meshes of. Faces are not looked at; without "weight" all weights are equal; weights are
/// scaled to a sum of 1. \throws Error as vertexCovariances() does for CovarianceKind::kDefinite, for a weight that is
/// not above 0 and finite, for positions that are not finite and for a mesh without vertices; std::invalid_argument as
/// Mesh says.
[[nodiscard]] GaussianMixture mixtureOf(const Mesh& mesh);

}  // namespace pdc
