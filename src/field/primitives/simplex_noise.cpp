#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "field/arguments.h"
#include "field/interval_arithmetic.h"
#include "field/primitives/simplex_kernel.h"
#include "math/lane_loops.h"
#include "pdc/field/noise.h"

namespace pdc {
namespace {

using detail::ValueGradient;

constexpr int kMaxOctaves = 16;

struct Octave {
  double frequency, amplitude;
  std::uint32_t seed;
};

/// Points are taken in batches, one per lane, octave by octave.
class SimplexNoise final : public Field {
 public:
  explicit SimplexNoise(std::vector<Octave> octaves) : mOctaves(std::move(octaves)) {}

  void values(PointSpan points, double* values) const override {
    forEachPointBatch(points, [&](std::size_t first, std::size_t size, const Lanes& p) {
      Lanes f;
      addOctaves(p, f);
      std::copy_n(f.value.data(), size, values + first);
    });
  }

  void gradients(PointSpan points, double* values, GradientSpan gradients) const override {
    forEachPointBatch(points, [&](std::size_t first, std::size_t size, const Lanes& p) {
      Lanes f;
      addOctaves<true>(p, f);
      std::copy_n(f.value.data(), size, values + first);
      std::copy_n(f.x.data(), size, gradients.x + first);
      std::copy_n(f.y.data(), size, gradients.y + first);
      std::copy_n(f.z.data(), size, gradients.z + first);
    });
  }

  /// Adds for each octave the tightest of what follows from its range, from its largest slope, and from its slope at
  /// the centre and its curvature.
  [[nodiscard]] Interval bound(const Box& box) const override {
    Interval range{0, 0};
    double magnitude = 0;
    for (const auto& [frequency, amplitude, seed] : mOctaves) {
      const Vec3d center = box.center() * frequency;
      const double radius = box.radius() * frequency;
      const ValueGradient f = detail::simplexOctave(center, seed);
      const double reach =
          std::min(detail::kSimplexSlope * radius,
                   detail::extent(box, f.gradient) * frequency + detail::kSimplexCurvature / 2 * radius * radius);
      const Interval octaveRange = detail::intersection({-1, 1}, detail::around(f.value, reach));
      range = detail::sum(range, detail::product(octaveRange, amplitude));
      magnitude += amplitude * (1 + frequency * largestEntry(box));
    }
    return detail::widened(range, magnitude);
  }

  [[nodiscard]] double lipschitz() const override {
    double slope = 0;
    for (const Octave& o : mOctaves) slope += o.amplitude * o.frequency * detail::kSimplexSlope;
    return slope;
  }

  /// Farther out cells are cut off, see simplex_kernel.h.
  [[nodiscard]] bool definedIn(const Box& box) const override {
    constexpr double kFarthest = 1e8;
    return std::all_of(mOctaves.begin(), mOctaves.end(), [&](const Octave& o) {
      return o.frequency * largestEntry(box) < kFarthest && o.frequency < detail::kUsual &&
             o.amplitude < detail::kUsual;
    });
  }

 private:
  /// A batch of points, or a value and a gradient of each.
  struct Lanes {
    alignas(64) std::array<double, kLanes> x{}, y{}, z{}, value{};
  };

  /// Calls visit(first, size, points) for batches of points; only the last one may have unused lanes, which are zero.
  template <typename Visit>
  static void forEachPointBatch(PointSpan points, const Visit& visit) {
    for (std::size_t first = 0; first < points.size; first += kLanes) {
      const std::size_t size = std::min(points.size - first, std::size_t{kLanes});
      Lanes p;
      std::copy_n(points.x + first, size, p.x.data());
      std::copy_n(points.y + first, size, p.y.data());
      std::copy_n(points.z + first, size, p.z.data());
      visit(first, size, p);
    }
  }

  /// Adds the values of all octaves, and the gradients if they are wanted, to f.
  template <bool kGradients = false>
  void addOctaves(const Lanes& p, Lanes& f) const {
    detail::forEachBatch(mLevel, mOctaves.size(), [&](std::size_t i) {
      const double frequency = mOctaves[i].frequency, amplitude = mOctaves[i].amplitude;
      const std::uint32_t seed = mOctaves[i].seed;
      detail::forEachLane([&](int lane) {
        const Vec3d x{p.x[lane] * frequency, p.y[lane] * frequency, p.z[lane] * frequency};
        const ValueGradient octave = detail::simplexOctave(x, seed);
        f.value[lane] += amplitude * octave.value;
        if constexpr (kGradients) {
          f.x[lane] += octave.gradient.x * (amplitude * frequency);
          f.y[lane] += octave.gradient.y * (amplitude * frequency);
          f.z[lane] += octave.gradient.z * (amplitude * frequency);
        }
      });
    });
  }

  std::vector<Octave> mOctaves;
  SimdLevel mLevel = bestSimdLevel();
};

}  // namespace

FieldPtr simplexNoise(const NoiseOptions& options) {
  if (options.octaves < 1 || options.octaves > kMaxOctaves)
    throw std::invalid_argument(fmt::format("noise octaves must be 1 to {}, not {}", kMaxOctaves, options.octaves));
  detail::requirePositive("noise frequency", options.frequency);
  detail::requirePositive("noise gain", options.gain);
  detail::requirePositive("noise lacunarity", options.lacunarity);
  detail::requireNotNegative("noise amplitude", options.amplitude);
  std::vector<Octave> octaves;
  double frequency = options.frequency, amplitude = options.amplitude;
  for (int i = 0; i < options.octaves; ++i) {
    detail::requirePositive("noise frequency of the last octave", frequency);
    detail::requireNotNegative("noise amplitude of the last octave", amplitude);
    octaves.push_back({frequency, amplitude, detail::octaveSeed(options.seed, i)});
    frequency *= options.lacunarity;
    amplitude *= options.gain;
  }
  return std::make_shared<SimplexNoise>(std::move(octaves));
}

}  // namespace pdc
