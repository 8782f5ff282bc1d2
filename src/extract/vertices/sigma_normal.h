#pragma once

#include <cmath>

#include "pdc/math/sym_mat3.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// How much the normals of a patch differ.
template <typename T>
struct PatchSpread {
  T excess;  ///< Beyond their noise: the mean squared sine of the angle between two of them.
  T noise;   ///< The variance of each of their components.
};

/// The σn that a vertex's planes are taken to have: the same for all, or from the data, patch by patch.
///
/// Where the normals of a patch differ by no more than their noise it is flat, and takes a σn well above that noise:
/// the vertex stays at the middle of its crossings. Where they differ by more, and agree with where the crossings lie
/// as on a surface that bends evenly (see chordResidual()), it is curved, and takes kCurved: vertices then lie as far
/// outside of the surface as the middles of faces inside. Where they do not agree with it there is a crease, which
/// takes a σn no larger than the noise demands. All of it is continuous in the data.
class SigmaNormal {
 public:
  /// One σn for all patches, from 0 to infinity; no unit.
  SigmaNormal(double sigma) : mVariance(sigma * sigma) {}
  /// Patch by patch, from what the source knows of the noise of its normals, or else from that which setNoise() tells.
  static SigmaNormal fromData(const HermiteSource& source);
  /// Patch by patch. \param noise standard deviation of each component of the unit normals.
  static SigmaNormal ofNoise(double noise);

  /// The noise of the normals of the block whose patches follow; nothing happens unless σn is of patches.
  void setNoise(double noise);
  /// Whether it has to be told the noise.
  [[nodiscard]] bool needsNoise() const { return mNeedsNoise; }
  [[nodiscard]] bool ofPatches() const { return mOfPatches; }
  /// σn² of all patches, or of creases.
  [[nodiscard]] double variance() const { return mVariance; }
  /// How much the normals of a patch differ beyond their noise: the mean of the squared sine of the angle between two
  /// of them. \param A Σrrᵀ of its planes; \param weight the sum of their weights; \param H inverse of the metric in
  /// which r are unit vectors.
  template <typename T>
  [[nodiscard]] PatchSpread<T> spread(const SymMat3<T>& A, T weight, const SymMat3<T>& H) const {
    const Vec3<T> b0 = H * Vec3<T>{A.xx, A.xy, A.xz}, b1 = H * Vec3<T>{A.xy, A.yy, A.yz},
                  b2 = H * Vec3<T>{A.xz, A.yz, A.zz};
    return spreadFromTraces(b0.x + b1.y + b2.z,
                            b0.x * b0.x + b1.y * b1.y + b2.z * b2.z + 2 * (b0.y * b1.x + b0.z * b2.x + b1.z * b2.y),
                            weight);
  }
  /// As above, where H = I.
  template <typename T>
  [[nodiscard]] PatchSpread<T> spread(const SymMat3<T>& A, T weight) const {
    return spreadFromTraces(
        A.trace(), A.xx * A.xx + A.yy * A.yy + A.zz * A.zz + 2 * (A.xy * A.xy + A.xz * A.xz + A.yz * A.yz), weight);
  }
  /// σn² of a patch. \param residual mean square of its chord residuals.
  template <typename T>
  [[nodiscard]] T variance(const PatchSpread<T>& spread, T residual) const {
    const auto c = [](double v) { return static_cast<T>(v); };
    const T beyond = residual - c(kResidualOfNoise) * spread.noise, disagreement = beyond > 0 ? beyond : T(0),
            ratio = disagreement / (spread.excess + c(kTiny));
    // The share of normals that cannot come from a crease.
    const T wrong = mAllCreases ? T(1) : clamped((ratio - c(mMostOfCrease)) / c(1 - kMostOfCrease));
    const T noise = spread.noise + wrong * disagreement / c(kResidualOfNoise);
    const T ofNoise = c(kSpreadOfNoise) * noise, share = ofNoise / (ofNoise + spread.excess + c(kTiny));
    const T deviation = std::sqrt(noise),
            smooth = c(kCurved) + c(kRough) * clamped((spread.noise - c(kRoughVariance)) / c(kRoughVariance)) +
                     share * (c(kFlat) + c(kFlatPerNoise) * deviation);
    const T known =
        clamped(ratio / c(mCertainShare)) * (1 - wrong) * clamped(1 - spread.noise / c(kMostVarianceOfCrease));
    const T beyondLeast = spread.excess - c(kLeastSpread);
    const T crease = known * (beyondLeast > 0 ? beyondLeast : T(0)) /
                     (c(kCreaseSpread) + c(kCreaseSpreadPerVariance) * spread.noise);
    return c(mVariance) + smooth * smooth / (1 + crease * crease);
  }
  /// Where the excess is less nothing is a crease, and the residual need not be known.
  static constexpr double kLeastSpread = 0.003;

 private:
  // The constants were chosen with bench/kinds_eval: the tuning kinds as fogs, noise 0, 0.02 and 0.1 voxels.

  /// σn at creases without noise: below it creases gain nothing.
  static constexpr double kLeast = 0.02;
  /// σn of curved patches. With 0.05 normals of spheres are 3 to 9 % worse and their surfaces up to 25 %, with 0.7
  /// surfaces are two to four times worse.
  static constexpr double kCurved = 0.2;
  /// How much that grows in rough data, such as smoke, and the variance of the normals, 7° of noise in each component,
  /// from which on it does.
  static constexpr double kRough = 1, kRoughVariance = 0.015;
  /// What flat patches with noise get more, and how that grows with noise.
  static constexpr double kFlat = 1.1, kFlatPerNoise = 1.6;
  /// The spread that noise makes, over its variance. It would be four for independent normals; those of a cell share
  /// values.
  static constexpr double kSpreadOfNoise = 1.45;
  /// The residual that noise makes, over its variance, where it happens to be large.
  static constexpr double kResidualOfNoise = 4;
  /// From which share of the excess on the residual is that of a crease. Exact normals have none on spheres and
  /// cylinders of any size.
  static constexpr double kCertainShare = 0.5, kCertainShareOfExact = 0.02;
  /// Creases have residuals of at most this share; normals with more are wrong, as on walls of a voxel, and count as
  /// noise.
  static constexpr double kMostOfCrease = 0.6;
  /// Where normals have this variance, 8° of noise in each component, no crease can be told from it.
  static constexpr double kMostVarianceOfCrease = 0.02;
  /// The excess at which a crease is half-way between smooth and sharp, and how it grows with the noise's variance.
  static constexpr double kCreaseSpread = 0.006, kCreaseSpreadPerVariance = 6.4;
  /// No division by zero.
  static constexpr double kTiny = 1e-9;

  /// From the traces of B = HA and of B², where A = Σ wᵢ(nᵢnᵢᵀ + vᵢI) over planes with weights wᵢ and
  /// variances vᵢ of their own. Of the planes alone, P = Σ wᵢnᵢnᵢᵀ, the ratio 1 − tr P² / (tr P)² is zero where all
  /// normals agree, and twice their variance where that is small.
  template <typename T>
  [[nodiscard]] PatchSpread<T> spreadFromTraces(T trace, T traceOfSquare, T weight) const {
    const auto c = [](double v) { return static_cast<T>(v); };
    // tr B is Σ wᵢ(1 + 3vᵢ): what it exceeds the weight by tells the mean of the vᵢ, v. Then P = B − Σwᵢ v I.
    const T excess = (trace / weight - 1) / 3;
    const T ownVariance = mOwnNoise && excess > 0 ? excess : T(0);
    const T noiseVariance = ownVariance + c(mNoise * mNoise), added = weight * ownVariance;
    const T squareOfTrace = (trace - 3 * added) * (trace - 3 * added);
    const T difference = squareOfTrace - (traceOfSquare + added * (3 * added - 2 * trace));
    const T spread = squareOfTrace > 0 ? difference / squareOfTrace : T(0);
    const T beyondNoise = spread - c(kSpreadOfNoise) * noiseVariance;
    return {beyondNoise > 0 ? beyondNoise : T(0), noiseVariance};
  }

  template <typename T>
  static T clamped(T v) {
    return v < 0 ? T(0) : v > 1 ? T(1) : v;
  }

  double mVariance;
  double mNoise = 0;
  double mCertainShare = kCertainShare, mMostOfCrease = kMostOfCrease;
  bool mOfPatches = false, mOwnNoise = false, mNeedsNoise = false, mAllCreases = false;
};

}  // namespace pdc::detail
