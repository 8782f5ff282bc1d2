#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/pointwise_field.h"
#include "field/simplex_kernel.h"
#include "pdc/field/noise.h"

namespace pdc {
namespace {

using detail::ValueGradient;

constexpr int kMaxOctaves = 16;

struct SimplexNoise {
  struct Octave {
    double frequency, amplitude;
    std::uint32_t seed;
  };
  Octave octave[kMaxOctaves];
  int octaves;

  [[nodiscard]] double value(const Vec3d& p) const { return gradient(p).value; }

  [[nodiscard]] ValueGradient gradient(const Vec3d& p) const {
    ValueGradient sum{0, {}};
    for (int i = 0; i < octaves; ++i) {
      const auto& [frequency, amplitude, seed] = octave[i];
      const ValueGradient f = detail::simplexOctave(p * frequency, seed);
      sum.value += amplitude * f.value;
      sum.gradient += f.gradient * (amplitude * frequency);
    }
    return sum;
  }

  /// Per octave what follows from its range, from its slope, and from its slope at the centre and its curvature.
  [[nodiscard]] Interval bound(const Box& box) const {
    Interval range{0, 0};
    double magnitude = 0;
    for (int i = 0; i < octaves; ++i) {
      const auto& [frequency, amplitude, seed] = octave[i];
      const Vec3d center = box.center() * frequency;
      const double radius = box.radius() * frequency;
      const ValueGradient f = detail::simplexOctave(center, seed);
      const double reach =
          std::min(detail::kSimplexSlope * radius,
                   detail::extent(box, f.gradient) * frequency + detail::kSimplexCurvature / 2 * radius * radius);
      const Interval octaveRange = detail::intersection({-1, 1}, detail::around(f.value, reach));
      range = detail::sum(range, detail::product(octaveRange, amplitude));
      magnitude += amplitude * (1 + frequency * detail::largestEntry(box));
    }
    return detail::widened(range, magnitude);
  }

  [[nodiscard]] double lipschitz() const {
    double slope = 0;
    for (int i = 0; i < octaves; ++i) slope += octave[i].amplitude * octave[i].frequency * detail::kSimplexSlope;
    return slope;
  }
};

}  // namespace

FieldPtr simplexNoise(const NoiseOptions& options) {
  if (options.octaves < 1 || options.octaves > kMaxOctaves)
    throw std::invalid_argument(fmt::format("noise octaves must be 1 to {}, not {}", kMaxOctaves, options.octaves));
  detail::requirePositive("noise frequency", options.frequency);
  detail::requirePositive("noise gain", options.gain);
  detail::requirePositive("noise lacunarity", options.lacunarity);
  detail::requireNotNegative("noise amplitude", options.amplitude);
  SimplexNoise noise{};
  noise.octaves = options.octaves;
  double frequency = options.frequency, amplitude = options.amplitude;
  for (int i = 0; i < options.octaves; ++i) {
    detail::requirePositive("noise frequency of the last octave", frequency);
    detail::requireNotNegative("noise amplitude of the last octave", amplitude);
    noise.octave[i] = {frequency, amplitude, detail::octaveSeed(options.seed, i)};
    frequency *= options.lacunarity;
    amplitude *= options.gain;
  }
  return detail::makePointwise(noise);
}

}  // namespace pdc
