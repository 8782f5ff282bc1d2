#include "study/recommend_sigma.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pdc::detail {
namespace {

/// Where the largest and the smallest error differ by less than this share of the largest, the values are alike.
constexpr double kFlat = 0.05;

/// Where a σn lies on a logarithmic scale from 0.01 to 1: factors tell values of σn apart, not differences.
double place(double sigma) { return std::log(std::clamp(sigma, 0.01, 1.0)); }

}  // namespace

std::optional<double> trueError(const SweepStep& step) {
  if (!step.vertexRms) return std::nullopt;
  return std::hypot(*step.vertexRms, step.creaseRms.value_or(0));
}

void recommendSigma(Sweep& sweep) {
  const auto& steps = sweep.steps;
  const bool known = std::all_of(steps.begin(), steps.end(), [](const auto& s) { return trueError(s).has_value(); });
  // Without a truth the noise found in the normals is all there is to go by.
  const auto cost = [&](const SweepStep& s) {
    return known ? *trueError(s) : std::abs(place(s.value) - place(sweep.normalNoise));
  };
  const auto [best, worst] =
      std::minmax_element(steps.begin(), steps.end(), [&](const auto& a, const auto& b) { return cost(a) < cost(b); });
  if (known && cost(*worst) - cost(*best) <= kFlat * cost(*worst)) {
    sweep.reason =
        fmt::format("The curve is flat: errors lie between {:.4f} and {:.4f} voxels, so any of these values does.",
                    cost(*best), cost(*worst));
    return;
  }
  sweep.recommended = static_cast<std::size_t>(best - steps.begin());
  if (known) {
    sweep.reason =
        fmt::format("sigma_n = {} has the lowest true error, {:.4f} voxels ({}); the highest is {:.4f}, at {}.",
                    best->value, cost(*best), best->creaseRms ? "of vertices and creases together" : "of the vertices",
                    cost(*worst), worst->value);
  } else {
    sweep.reason = fmt::format(
        "sigma_n = {} is nearest to the noise found in the input: from one crossing to the next a component of the "
        "unit normals differs with a standard deviation of {:.3f}. The true surface is not known, so this is an "
        "estimate.",
        best->value, sweep.normalNoise);
  }
}

}  // namespace pdc::detail
