#include "sample/implicit/edge_roots.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pdc::detail {
namespace {

constexpr double kTolerance = 0x1p-20;
// From here on only bisection. Smooth functions need at most 8 steps, a triple root 24.
constexpr int kInterpolationSteps = 40;

struct Sample {
  double t, f;
};

/// The change of sign lies between `newest` and `opposite`; `previous` is the point that left the bracket last.
struct Bracket {
  Sample newest, opposite, previous;

  [[nodiscard]] double width() const { return std::abs(opposite.t - newest.t); }
  void add(const Sample& sample) {
    const bool sameSide = isInside(sample.f) == isInside(newest.f);
    previous = std::exchange(newest, sample);
    if (!sameSide) std::swap(previous, opposite);
  }
};

/// Share of the way from a to b where the straight line through them is zero; one half if they do not tell.
double secantShare(const Sample& a, const Sample& b) {
  const double share = a.f / (a.f - b.f);
  return share >= 0 && share <= 1 ? share : 0.5;
}

double between(const Sample& a, const Sample& b, double share) { return a.t + share * (b.t - a.t); }

/// Share of the way from the newest to the opposite sample by inverse quadratic interpolation, if the three samples lie
/// on a curve that has an inverse there; else one half.
double interpolatedShare(const Bracket& bracket) {
  const auto& [a, b, c] = bracket;
  const double xi = (a.t - b.t) / (c.t - b.t), phi = (a.f - b.f) / (c.f - b.f);
  if (!(phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)) return 0.5;
  const double share =
      a.f / (b.f - a.f) * c.f / (b.f - c.f) + (c.t - a.t) / (b.t - a.t) * a.f / (c.f - a.f) * b.f / (c.f - b.f);
  return std::isfinite(share) ? share : 0.5;
}

double nextPoint(const Bracket& bracket, int step) {
  const auto& [newest, opposite, previous] = bracket;
  if (step >= kInterpolationSteps) return between(newest, opposite, 0.5);
  const double share = step == 0 ? secantShare(newest, opposite) : interpolatedShare(bracket);
  // Stepping half a tolerance beyond a good estimate brings the other end of the bracket in.
  const double least = 0.5 * kTolerance / bracket.width();
  return between(newest, opposite, std::clamp(share, least, 1 - least));
}

/// The crossing within a bracket that is small enough. Where the function has no value on one side it is the last point
/// that has one, so that a normal can be found there.
double finalPoint(const Bracket& bracket) {
  const auto& [newest, opposite, previous] = bracket;
  if (std::isfinite(newest.f) == std::isfinite(opposite.f))
    return between(newest, opposite, secantShare(newest, opposite));
  return std::isfinite(newest.f) ? newest.t : opposite.t;
}

using Brackets = std::array<Bracket, EdgeBatch::kCapacity>;

void evaluateEnds(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, Brackets& brackets) {
  EdgePoints points;
  std::array<double, EdgeBatch::kCapacity> values;
  const auto evaluate = [&](double t, Sample Bracket::*end) {
    for (std::size_t i = 0; i < edges.size; ++i) points.place(i, frame, edges, i, t);
    field.values(points.span(edges.size), values.data());
    for (std::size_t i = 0; i < edges.size; ++i) brackets[i].*end = {t, values[i]};
  };
  evaluate(0, &Bracket::newest);
  evaluate(1, &Bracket::opposite);
}

}  // namespace

void EdgePoints::place(std::size_t to, const LatticeFrame& frame, const EdgeBatch& edges, std::size_t edge, double t) {
  for (int axis = 0; axis < 3; ++axis)
    p[axis][to] = frame.at(axis, edges.low[axis][edge] + (edges.axis[edge] == axis ? t : 0));
}

void findEdgeRoots(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, double* t) {
  Brackets brackets;
  evaluateEnds(field, frame, edges, brackets);

  std::array<std::uint16_t, EdgeBatch::kCapacity> active;
  std::size_t count = edges.size;
  for (std::size_t i = 0; i < count; ++i) active[i] = static_cast<std::uint16_t>(i);

  EdgePoints points;
  std::array<double, EdgeBatch::kCapacity> next, values;
  for (int step = 0; count > 0; ++step) {
    for (std::size_t k = 0; k < count; ++k) {
      next[k] = nextPoint(brackets[active[k]], step);
      points.place(k, frame, edges, active[k], next[k]);
    }
    field.values(points.span(count), values.data());
    std::size_t left = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint16_t i = active[k];
      brackets[i].add({next[k], values[k]});
      if (brackets[i].width() > kTolerance) active[left++] = i;
    }
    count = left;
  }
  for (std::size_t i = 0; i < edges.size; ++i) t[i] = finalPoint(brackets[i]);
}

}  // namespace pdc::detail
