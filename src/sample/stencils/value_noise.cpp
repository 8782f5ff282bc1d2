#include "sample/stencils/value_noise.h"

#include <algorithm>
#include <cmath>

#include "sample/creases/one_sided_slopes.h"

namespace pdc::detail {
namespace {

/// The largest σn that is used: a normal with that much noise has no influence.
constexpr float kMostSigma = 10;

/// The value of a companion where an edge crosses, linear along the edge; what is negative or not finite counts as
/// 0.
float valueAt(const DistanceStencil& stencil, int low, int axis, float t) {
  const auto known = [&](int i) {
    const float v = stencil.value[i];
    return v >= 0 ? v : 0.0F;
  };
  return (1 - t) * known(low) + t * known(low + DistanceStencil::kStep[axis]);
}

/// Calls visit(edge, axis, index of its low end in a stencil) for each edge.
template <typename Visit>
void forEachLow(const EdgeIndex& edges, Visit&& visit) {
  edges.forEach([&](int i, int axis, int x, int y, int z) { visit(i, axis, DistanceStencil::index(x, y, z)); });
}

/// The gradient's length where an edge crosses, per voxel along the lattice, from the central differences that its
/// normal is made of; NaN beside clamped values. Normals have one-sided differences there (see fillFromStencil()).
float slopeAt(const DistanceStencil& values, int low, int axis, float t) {
  const auto& v = values.value;
  const int high = low + DistanceStencil::kStep[axis];
  const float along = v[high] - v[low];
  float squares = along * along;
  for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
    const int s = DistanceStencil::kStep[other];
    const float across = (1 - t) * centralSlope(&v[low], s) + t * centralSlope(&v[high], s);
    if (std::isfinite(across)) squares += across * across;  // Not beside clamped values.
  }
  return std::sqrt(squares);
}

/// Standard deviation of a component of the normal, the mean over components, where values have deviation one and the
/// gradient has length one: a difference along the edge has twice the variance of a value, differences across it are
/// halved and blended from both ends.
float stencilNoise(float t) {
  const float across = 0.5F * ((1 - t) * (1 - t) + t * t);
  return std::sqrt((2 + 2 * across) / 3);
}

}  // namespace

SourceKnowledge::Noise ValueNoise::knowledge() const {
  using Noise = SourceKnowledge::Noise;
  return sigma != nullptr ? Noise::kSigma : weight != nullptr ? Noise::kWeights : Noise::kNone;
}

void ValueNoise::fill(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite,
                      const DistanceReader& values, PlaneNoise& noise) const {
  DistanceStencil stencil;
  if (weight != nullptr) {
    weight->readDistances(block, 1, stencil);
    forEachLow(edges, [&](int i, int axis, int low) { noise.weight[i] = valueAt(stencil, low, axis, hermite.t[i]); });
  } else {
    std::fill_n(noise.weight.begin(), edges.size(), 1.0F);
  }
  if (sigma == nullptr) {
    std::fill_n(noise.sigma.begin(), edges.size(), 0.0F);
    return;
  }
  sigma->readDistances(block, 1, stencil);
  forEachLow(edges, [&](int i, int axis, int low) { noise.sigma[i] = valueAt(stencil, low, axis, hermite.t[i]); });
  values.readDistances(block, 1, stencil);
  forEachLow(edges, [&](int i, int axis, int low) {
    if (noise.sigma[i] == 0) return;
    const float ratio = noise.sigma[i] / slopeAt(stencil, low, axis, hermite.t[i]);
    const float spread = stencilNoise(hermite.t[i]) * ratio;
    noise.sigma[i] = spread < kMostSigma ? spread : kMostSigma;  // NaN beside values that are clamped or not finite.
  });
}

double ValueNoise::largestSigma(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite) const {
  DistanceStencil stencil;
  sigma->readDistances(block, 1, stencil);
  float largest = 0;
  forEachLow(edges,
             [&](int i, int axis, int low) { largest = std::max(largest, valueAt(stencil, low, axis, hermite.t[i])); });
  return double{largest};
}

}  // namespace pdc::detail
