#pragma once

#include <cstdint>

#include "pdc/field/field.h"

namespace pdc {

/// The octaves of fractal simplex noise.
struct NoiseOptions {
  std::uint32_t seed = 0;
  int octaves = 4;          ///< 1 to 16.
  double frequency = 1.0;   ///< Lattice cells per world unit in the first octave, > 0.
  double gain = 0.5;        ///< Ratio of an octave's amplitude to that of the octave before, > 0.
  double lacunarity = 2.0;  ///< Ratio of an octave's frequency to that of the octave before, > 0.
  double amplitude = 1.0;   ///< The first octave lies in [-amplitude, amplitude]; >= 0.
};

/// Fractal noise: the sum over octaves i of amplitude · gain^i · s_i(frequency · lacunarity^i · p), where s_i in [-1,
/// 1] is three-dimensional simplex noise (K. Perlin 2001; S. Gustavson 2005) whose seed depends on `seed` and i alone.
///
/// The gradient is exact, and the function is twice continuously differentiable. The same options give the same values
/// on every platform. An octave is zero beyond 2^30 of its cells from the origin along any axis of its skewed lattice.
/// bound() combines range, slope and curvature of each octave; lipschitz() is finite. The value is no distance.
/// \throws std::invalid_argument for options out of range or not finite, and if the
/// frequency of an octave over- or underflows or its amplitude overflows.
FieldPtr simplexNoise(const NoiseOptions& options);

}  // namespace pdc
