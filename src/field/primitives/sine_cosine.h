#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numbers>

namespace pdc::detail {

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine without branches, so that loops over them vectorise, and with the same bits however they are
/// compiled.
///
/// Within 3e-16 + |x| 2⁻⁵² of the true ones for |x| < 2⁵⁰, and in [-1, 1] for any finite x. The angle is reduced to π/4
/// about a multiple of π/2, whose 33 leading bits are subtracted first (Cody & Waite 1980); the polynomials are those
/// of Sun's fdlibm.
inline SineCosine sineCosine(double x) {
  constexpr double kLead = 1.57079632673412561417e+00, kMiddle = 6.07710050630396597660e-11,
                   kTail = 2.02226624879595063154e-21;
  // Adding kRound rounds to a whole number, whose last bits are then those of the sum.
  constexpr double kRound = 0x1.8p52, kQuarterTurn = std::numbers::pi / 4 * (1 + 1e-9);
  const double sum = x * (2 / std::numbers::pi) + kRound, turns = sum - kRound;
  const double unbounded = ((x - turns * kLead) - turns * kMiddle) - turns * kTail;
  const double r = std::min(std::max(unbounded, -kQuarterTurn), kQuarterTurn), z = r * r;
  const double sineSeries =
      -1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 +
           z * (-1.98412698298579493134e-04 +
                z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
  const double cosineSeries =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 +
                                                  z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))));
  const double s = r + r * z * sineSeries, c = 1 - (0.5 * z - z * z * cosineSeries);
  // Bits make the choices, because branches would not vectorise.
  const auto quadrant = std::bit_cast<std::uint64_t>(sum), odd = 0 - (quadrant & 1);
  const auto sineBits = std::bit_cast<std::uint64_t>(s), cosineBits = std::bit_cast<std::uint64_t>(c),
             swapped = (sineBits ^ cosineBits) & odd, sineSign = (quadrant & 2) << 62,
             cosineSign = ((quadrant + 1) & 2) << 62;
  return {std::bit_cast<double>(sineBits ^ swapped ^ sineSign),
          std::bit_cast<double>(cosineBits ^ swapped ^ cosineSign)};
}

}  // namespace pdc::detail
