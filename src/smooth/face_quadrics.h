#pragma once

#include <cstdint>
#include <span>

#include "parallel/block_progress.h"
#include "pdc/math/quadric.h"
#include "smooth/smoothed_surface.h"

namespace pdc::detail {

/// What neighbours have to say when quadrics are averaged.
enum class Averaging {
  kPlain,    ///< All the same (Trettner & Kobbelt 2020).
  kByNoise,  ///< The less, the more their normals differ from the face's beyond what noise explains.
};

/// The quadrics of a surface's faces, each about the middle of its face, so that nothing is lost far from the origin.
class FaceQuadrics {
 public:
  /// \param sigmas of the vertices, in mean edges. \param normaliseArea see SmoothOptions. \param surface outlives
  /// this.
  FaceQuadrics(const SmoothedSurface& surface, std::span<const double> sigmas, bool normaliseArea,
               BlockProgress& progress);

  /// Replaces each by the mean of it and those of its neighbours.
  void average(Averaging averaging, BlockProgress& progress);

  /// The sum over the faces at a vertex, about the vertex.
  [[nodiscard]] NormalEquations<double> sumAt(std::uint32_t vertex) const;

 private:
  [[nodiscard]] NormalEquations<double> ofTriangle(std::size_t face, std::span<const double> sigmas);
  [[nodiscard]] NormalEquations<double> ofWall(std::size_t face, std::span<const double> sigmas);
  /// \param variance of the vertices, in squares of the face's edges.
  void setNormal(std::size_t face, const Vec3d& normal, double variance);
  /// The quadric of a face about another point.
  [[nodiscard]] NormalEquations<double> about(std::uint32_t face, const Vec3d& point) const;
  void averagePlainly(std::size_t face);
  void averageByNoise(std::size_t face);
  [[nodiscard]] double weight(std::size_t face, std::uint32_t neighbour) const;

  const SmoothedSurface& mSurface;
  Buffer<NormalEquations<double>> mQuadrics, mNext;
  Buffer<Vec3f> mNormals, mNextNormals;  ///< Averaged likewise, of length one, or zero.
  Buffer<float> mNormalNoise;            ///< The variance of each component of a normal before any averaging.
  double mNoiseLeft = 1;                 ///< What averaging has left of it.
};

}  // namespace pdc::detail
