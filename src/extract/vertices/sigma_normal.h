#pragma once

#include <cmath>

#include "pdc/math/sym_mat3.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// The σn that a vertex's planes are taken to have: the same for all, or from the data, patch by patch.
///
/// Where the normals of a patch differ by no more than their noise and some curvature it is flat, and nothing is lost
/// by a large σn: the vertex stays at the middle of its crossings, between the chord through them and the tangents at
/// them, one of which is as far inside a curved surface as the other outside. Where they differ by more there is a
/// crease, which takes a σn no larger than the noise demands.
class SigmaNormal {
 public:
  /// One σn for all patches, from 0 to infinity; no unit.
  SigmaNormal(double sigma) : mVariance(sigma * sigma) {}
  /// Patch by patch, from the noise of neighbouring normals in some of the blocks, or from what the source knows of
  /// each. Runs in parallel; the same for any number of threads.
  static SigmaNormal fromData(const HermiteSource& source, const SurfaceBlocks& blocks, const Monitor& monitor);
  /// Patch by patch. \param noise standard deviation of each component of the unit normals.
  static SigmaNormal ofNoise(double noise);
  /// Patch by patch, where matrices hold a variance of each plane already.
  static SigmaNormal ofOwnNoise();

  [[nodiscard]] bool ofPatches() const { return mOfPatches; }
  /// Estimated standard deviation of normals; 0 unless it was.
  [[nodiscard]] double noise() const { return mNoise; }
  /// σn² of all patches, or of creases.
  [[nodiscard]] double variance() const { return mVariance; }
  /// σn² of a patch. \param A Σrrᵀ of its planes; \param weight the sum of their weights; \param H inverse of the
  /// metric in which r are unit vectors.
  template <typename T>
  [[nodiscard]] T variance(const SymMat3<T>& A, T weight, const SymMat3<T>& H) const {
    const Vec3<T> b0 = H * Vec3<T>{A.xx, A.xy, A.xz}, b1 = H * Vec3<T>{A.xy, A.yy, A.yz},
                  b2 = H * Vec3<T>{A.xz, A.yz, A.zz};
    return varianceFromTraces(b0.x + b1.y + b2.z,
                              b0.x * b0.x + b1.y * b1.y + b2.z * b2.z + 2 * (b0.y * b1.x + b0.z * b2.x + b1.z * b2.y),
                              weight);
  }
  /// σn² of a patch where H = I.
  template <typename T>
  [[nodiscard]] T variance(const SymMat3<T>& A, T weight) const {
    return varianceFromTraces(
        A.trace(), A.xx * A.xx + A.yy * A.yy + A.zz * A.zz + 2 * (A.xy * A.xy + A.xz * A.xz + A.yz * A.yz), weight);
  }

 private:
  // All constants were chosen with bench/feature_eval: plain gradients, the tuning shapes at 48³, noise 0 to 0.1
  // voxels.

  /// σn at creases without noise: below it creases gain nothing.
  static constexpr double kLeast = 0.02;
  /// σn on flat parts without noise, which cancels the error of curvature there, and how it grows with noise, whose
  /// error takes over.
  static constexpr double kFlat = 0.7, kFlatPerNoise = 4;
  /// The spread of normals half-way between flat and crease without noise, and how it grows with the noise's variance.
  static constexpr double kSpread = 0.01, kSpreadPerVariance = 4;

  /// σn² of a patch from the traces of B = HA and of B², where A = Σ wᵢ(nᵢnᵢᵀ + vᵢI) over planes with weights wᵢ and
  /// variances vᵢ of their own. Of the planes alone, P = Σ wᵢnᵢnᵢᵀ, the ratio 1 − tr P² / (tr P)² is zero where all
  /// normals agree, and twice their variance where that is small.
  template <typename T>
  [[nodiscard]] T varianceFromTraces(T trace, T traceOfSquare, T weight) const {
    const auto c = [](double v) { return static_cast<T>(v); };
    // tr B is Σ wᵢ(1 + 3vᵢ): what it exceeds the weight by tells the mean of the vᵢ, v. Then P = B − Σwᵢ v I.
    const T excess = (trace / weight - 1) / 3;
    const T ownVariance = mOwnNoise && excess > 0 ? excess : T(0);
    const T noiseVariance = ownVariance + c(mNoise * mNoise), added = weight * ownVariance;
    const T squareOfTrace = (trace - 3 * added) * (trace - 3 * added);
    const T difference = squareOfTrace - (traceOfSquare + added * (3 * added - 2 * trace));
    const T half = c(kSpread) + c(kSpreadPerVariance) * noiseVariance;
    const T spread = squareOfTrace > 0 ? difference / (half * squareOfTrace) : T(0);
    const T flatSigma = c(kFlat) + c(kFlatPerNoise) * std::sqrt(noiseVariance);
    return c(mVariance) + flatSigma * flatSigma / (1 + spread * spread);
  }

  double mVariance;
  double mNoise = 0;
  bool mOfPatches = false, mOwnNoise = false;
};

}  // namespace pdc::detail
