#pragma once

#include <cstdint>

#include "field/pointwise_field.h"

namespace pdc::detail {

/// One octave of simplex noise at unit frequency: in [-1, 1], three times continuously differentiable. Lattices of
/// different seeds are independent. Beyond 2^30 lattice cells from the origin it is zero.
ValueGradient simplexOctave(const Vec3d& p, std::uint32_t seed);

/// The seed of octave `octave`.
std::uint32_t octaveSeed(std::uint32_t seed, int octave);

/// Largest length of an octave's gradient and largest norm of its second derivative. The maxima over the simplex and
/// all choices of corner gradients, found by search from 3·10⁵ and 3·10⁴ samples, are 6.9654 and 48.241.
inline constexpr double kSimplexSlope = 7.0;
inline constexpr double kSimplexCurvature = 49.0;

}  // namespace pdc::detail
