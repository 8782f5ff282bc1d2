#pragma once

#include <cstdint>

#include "pdc/field/field.h"

namespace pdc {

/// Fractal simplex noise: sum over octaves i of gain^i · simplex(lacunarity^i · frequency · p).
struct NoiseOptions {
  std::uint32_t seed = 0;
  int octaves = 4;          ///< 1 to 16.
  double frequency = 1.0;   ///< Per world unit, > 0, of the first octave.
  double gain = 0.5;        ///< Amplitude from one octave to the next, > 0.
  double lacunarity = 2.0;  ///< Frequency from one octave to the next, > 0.
  double amplitude = 1.0;   ///< Of the first octave; one octave lies in [-amplitude, amplitude].
};

/// Three-dimensional simplex noise (K. Perlin 2001; S. Gustavson 2005) with its exact gradient. Twice continuously
/// differentiable. The same values on every platform for the same seed.
FieldPtr simplexNoise(const NoiseOptions& options);

}  // namespace pdc
