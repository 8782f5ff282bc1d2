#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/mesh.h"

// Lengths are in mean edge lengths of the mesh, and variances in their squares, except where it says otherwise.
namespace pdc::detail {

/// Noise of vertices that is small beside this counts as none where it is measured: 0.02 to 0.04 is what sampling does
/// to clean surfaces, on contoured scans.
inline constexpr double kFadeMeasured = 0.08;
/// And where it is given. With 0.08 meshes whose noise grows from 0 to 0.5 lie 2 % farther from the clean ones.
inline constexpr double kFadeGiven = 0.03;

/// What noise of the vertices asks for.
struct NoiseChoice {
  double sigmaNormal, sigmaPosition, memory;  ///< See DecimateOptions.
};

/// \param noise standard deviation of the vertices. \param fade see kFadeMeasured.
[[nodiscard]] NoiseChoice choiceFor(double noise, double fade);

/// The noise that is known of each vertex: variances, or covariances. Where there is none all faces count alike.
class VertexNoise {
 public:
  /// No noise is known.
  VertexNoise() = default;
  /// \param property see DecimateOptions::sigmaProperty. \param unit the mean edge length, in world units. \throws
  /// Error that names the property, or the first vertex with a number that is none of a standard deviation or a
  /// covariance.
  VertexNoise(const Mesh& mesh, const std::string& property, double unit);

  [[nodiscard]] bool known() const { return !mCount.empty(); }
  /// The mean of the vertices' standard deviations, for covariances in the mean over all directions.
  [[nodiscard]] double mean() const;
  /// The variance of a vertex along a direction. \param direction of any length; along 0 there is no variance.
  [[nodiscard]] double variance(std::uint32_t vertex, const Vec3d& direction) const;

  /// How much the squared distance to a face counts, above 0 and at most 1: in inverse proportion to the variance of
  /// its plane, the mean of that of its corners, where that is not small. \param normal of any length.
  [[nodiscard]] double trust(const Triangle& face, const Vec3d& normal) const;

  /// What the noise of a vertex along a direction asks for.
  [[nodiscard]] NoiseChoice choice(std::uint32_t vertex, const Vec3d& direction) const;

  /// Gives vertex a the mean over all vertices given that became it or b. It is what the input has there, not what is
  /// left of it after averaging, because errors are measured to the input. Calls for different a may run at the same
  /// time, if none reads another's a.
  void merge(std::uint32_t a, std::uint32_t b);

 private:
  void readVariances(const Mesh& mesh, const std::string& property, double unit);
  void readCovariances(const Mesh& mesh, double unit);

  // One of both, by vertex.
  std::vector<double> mVariances;
  std::vector<SymMat3<double>> mCovariances;
  std::vector<std::uint32_t> mCount;  ///< By vertex, how many given ones it stands for.
};

}  // namespace pdc::detail
