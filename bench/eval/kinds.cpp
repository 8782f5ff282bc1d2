#include "eval/kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include "pdc/field/noise.h"

namespace pdc::eval {
namespace {

constexpr double kPi = std::numbers::pi;

Kind sphere(double radius, bool heldOut) {
  return {.shape = smoothShape(fmt::format("sphere_{}", radius), heldOut,
                               [radius](const Vec3d& p) { return length(p) - radius; }),
          .reach = radius,
          .poses = radius < 4 ? 12U : 4U};
}

struct Ball {
  Vec3d center;
  double radius;
};

/// The parts of the circles in which spheres meet that no third sphere covers.
std::vector<Segment> meetings(const std::vector<Ball>& balls) {
  std::vector<Segment> out;
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Ball &a = balls[i], &b = balls[k];
      const Vec3d axis = b.center - a.center;
      const double d = length(axis);
      if (d >= a.radius + b.radius || d <= std::abs(a.radius - b.radius)) continue;
      const double along = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d),
                   r = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
      const Vec3d n = axis * (1 / d), other = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
      Vec3d u = cross(n, other);
      u *= 1 / length(u);
      const Vec3d v = cross(n, u), center = a.center + n * along;
      const int steps = std::max(8, static_cast<int>(2 * kPi * r / 0.1));
      const auto at = [&](int s) {
        const double angle = 2 * kPi * s / steps;
        return center + u * (r * std::cos(angle)) + v * (r * std::sin(angle));
      };
      for (int s = 0; s < steps; ++s) {
        const Vec3d middle = (at(s) + at(s + 1)) * 0.5;
        const auto covers = [&](const Ball& c) { return &c != &a && &c != &b && length(middle - c.center) < c.radius; };
        if (std::none_of(balls.begin(), balls.end(), covers)) out.push_back({at(s), at(s + 1)});
      }
    }
  return out;
}

/// Spheres with centres in a cube, in voxels.
struct Scatter {
  int count;
  double half;         ///< Half the cube's side.
  double least, most;  ///< Radii.
  unsigned seed;
};

Kind sphereUnion(std::string name, bool heldOut, const Scatter& s) {
  std::mt19937_64 random(s.seed);
  std::uniform_real_distribution<double> place(-s.half, s.half), size(s.least, s.most);
  auto balls = std::make_shared<std::vector<Ball>>();
  for (int i = 0; i < s.count; ++i) {
    const Vec3d center{place(random), place(random), place(random)};
    balls->push_back({center, size(random)});
  }
  Kind kind{.shape = smoothShape(std::move(name), heldOut,
                                 [balls](const Vec3d& p) {
                                   double nearest = std::numeric_limits<double>::infinity();
                                   for (const Ball& b : *balls)
                                     nearest = std::min(nearest, length(p - b.center) - b.radius);
                                   return nearest;
                                 }),
            .reach = std::sqrt(3.0) * (s.half + s.most)};
  kind.shape.creases = kind.shape.edges = meetings(*balls);
  return kind;
}

/// Capsules in random directions.
Kind strands(double radius, bool heldOut) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> place(-16, 16);
  auto all = std::make_shared<std::vector<Segment>>();
  for (int i = 0; i < 8; ++i) {
    const Vec3d a{place(random), place(random), place(random)}, b{place(random), place(random), place(random)};
    const auto clear = [&](const Segment& s) {
      for (int k = 0; k <= 64; ++k)
        for (int l = 0; l <= 64; ++l)
          if (length(a + (b - a) * (k / 64.0) - s[0] - (s[1] - s[0]) * (l / 64.0)) < 2 * radius + 3) return false;
      return true;
    };
    if (std::all_of(all->begin(), all->end(), clear)) all->push_back({a, b});
  }
  return {.shape = smoothShape(fmt::format("strands_{}", radius), heldOut,
                               [all, radius](const Vec3d& p) {
                                 double nearest = std::numeric_limits<double>::infinity();
                                 for (const auto& [a, b] : *all) {
                                   const Vec3d e = b - a;
                                   const double t = std::clamp(dot(p - a, e) / dot(e, e), 0.0, 1.0);
                                   nearest = std::min(nearest, length(p - a - e * t) - radius);
                                 }
                                 return nearest;
                               }),
          .reach = 30,
          .poses = 3};
}

/// A hollow sphere with a wall of a few voxels.
Kind film(double thickness, bool heldOut) {
  return {.shape = smoothShape(fmt::format("film_{}", thickness), heldOut,
                               [thickness](const Vec3d& p) { return std::abs(length(p) - 14) - thickness / 2; }),
          .reach = 16};
}

Kind torus(double tube, double ring, bool heldOut) {
  return {.shape = smoothShape(fmt::format("torus_{}", tube), heldOut,
                               [=](const Vec3d& p) { return std::hypot(std::hypot(p.x, p.y) - ring, p.z) - tube; }),
          .reach = ring + tube};
}

Kind filletedBox(double radius, bool heldOut) {
  return {.shape = smoothShape(
              fmt::format("fillet_{}", radius), heldOut,
              [radius](const Vec3d& p) {
                const Vec3d q{std::abs(p.x) - 16 + radius, std::abs(p.y) - 12 + radius, std::abs(p.z) - 9 + radius};
                const Vec3d out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
                return length(out) + std::min(0.0, std::max({q.x, q.y, q.z})) - radius;
              }),
          .reach = 23};
}

/// A function and its gradient, whose zero set is a smooth surface.
struct Implicit {
  std::function<double(const Vec3d&)> value;
  std::function<Vec3d(const Vec3d&)> gradient;

  /// The signed distance, from the foot point that Newton's steps find.
  [[nodiscard]] double distance(const Vec3d& p) const {
    constexpr int kSteps = 12;
    constexpr double kExact = 1e-6;
    const double sign = value(p) < 0 ? -1 : 1;
    Vec3d q = p;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3d g = gradient(q);
      const double squared = dot(g, g);
      if (!(squared > 0)) break;
      Vec3d step = g * (-value(q) / squared);
      const double l = length(step);
      if (l > 1) step *= 1 / l;  // Far away the function may be anything.
      const Vec3d across = p - q;
      const Vec3d along = across - g * (dot(across, g) / squared);
      if (l < kExact && length(along) < 1e-3) break;
      q += step + along * 0.5;
    }
    return sign * length(p - q);
  }
};

Kind implicitKind(std::string name, bool heldOut, const Implicit& f, double reach) {
  return {.shape = smoothShape(std::move(name), heldOut, [f](const Vec3d& p) { return f.distance(p); }),
          .reach = reach,
          .poses = 1,
          .gradient = f.gradient};
}

/// A gyroid that opens into the space around a ball.
Kind gyroid(double period, bool heldOut) {
  constexpr double kRadius = 12, kFade = 6;
  const double k = 2 * kPi / period;
  const auto beyond = [](double r) { return std::max(0.0, (r - kRadius) / kFade); };
  const auto value = [=](const Vec3d& p) {
    const double w = beyond(length(p));
    return std::sin(k * p.x) * std::cos(k * p.y) + std::sin(k * p.y) * std::cos(k * p.z) +
           std::sin(k * p.z) * std::cos(k * p.x) + 2 * w * w;
  };
  const auto gradient = [=](const Vec3d& p) {
    const double r = std::max(length(p), 1e-9);
    const Vec3d g{std::cos(k * p.x) * std::cos(k * p.y) - std::sin(k * p.z) * std::sin(k * p.x),
                  std::cos(k * p.y) * std::cos(k * p.z) - std::sin(k * p.x) * std::sin(k * p.y),
                  std::cos(k * p.z) * std::cos(k * p.x) - std::sin(k * p.y) * std::sin(k * p.z)};
    return g * k + p * (4 * beyond(r) / (kFade * r));
  };
  return implicitKind(fmt::format("gyroid_{}", period), heldOut, {value, gradient}, 24);
}

/// A ball whose radius varies with noise of one wavelength.
Kind roughBall(double wavelength, bool heldOut, unsigned seed) {
  const double amplitude = 0.25 * wavelength, radius = 16;
  const FieldPtr noise = simplexNoise({.seed = seed, .octaves = 1, .frequency = 1 / wavelength});
  const auto value = [=](const Vec3d& p) { return length(p) - radius - amplitude * noise->valueAt(p); };
  const auto gradient = [=](const Vec3d& p) {
    return p * (1 / std::max(length(p), 1e-9)) - noise->gradientAt(p) * amplitude;
  };
  return implicitKind(fmt::format("noise_{}", wavelength), heldOut, {value, gradient}, radius + amplitude + 2);
}

void addSolids(bool heldOut, std::vector<Kind>& kinds) {
  constexpr double kSize = 20;
  for (Shape& s : makeShapes(kSize)) {
    if (s.heldOut != heldOut || s.edges.empty()) continue;
    Kind kind{.shape = std::move(s), .size = kSize, .reach = 2 * kSize};
    kinds.push_back(std::move(kind));
  }
}

}  // namespace

std::vector<Kind> makeKinds(bool heldOut) {
  std::vector<Kind> kinds;
  if (!heldOut) {
    for (const double r : {1.5, 2.0, 3.0, 6.0, 10.0}) kinds.push_back(sphere(r, false));
    kinds.push_back(sphereUnion("droplets", false, {200, 18, 1.5, 3, 1}));
    kinds.push_back(sphereUnion("overlapping", false, {40, 16, 4, 7, 2}));
    kinds.push_back(strands(1.2, false));
    kinds.push_back(strands(2, false));
    for (const double t : {1.0, 2.0}) kinds.push_back(film(t, false));
    kinds.push_back(torus(2.4, 12, false));
    kinds.push_back(torus(6, 12, false));
    for (const double r : {1.0, 3.0}) kinds.push_back(filletedBox(r, false));
    kinds.push_back(gyroid(12, false));
    for (const double w : {4.0, 10.0, 30.0}) kinds.push_back(roughBall(w, false, 3));
  } else {
    for (const double r : {1.7, 2.3, 2.8, 4.5, 8.0}) kinds.push_back(sphere(r, true));
    kinds.push_back(sphereUnion("droplets_b", true, {250, 19, 1.6, 2.6, 11}));
    kinds.push_back(sphereUnion("overlapping_b", true, {30, 14, 3, 9, 12}));
    kinds.push_back(strands(1.6, true));
    for (const double t : {1.5, 3.0}) kinds.push_back(film(t, true));
    kinds.push_back(torus(1.8, 11, true));
    kinds.push_back(torus(4, 10, true));
    kinds.push_back(filletedBox(2, true));
    kinds.push_back(gyroid(9, true));
    for (const double w : {3.0, 6.0, 18.0}) kinds.push_back(roughBall(w, true, 13));
  }
  addSolids(heldOut, kinds);
  return kinds;
}

}  // namespace pdc::eval
