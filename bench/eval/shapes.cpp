#include "eval/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "eval/profile.h"

namespace pdc::eval {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Point2> rectangle(double a, double b) { return {{-a, -b}, {a, -b}, {a, b}, {-a, b}}; }

std::vector<Point2> regular(int n, double radius, double inner) {
  std::vector<Point2> out;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < (inner > 0 ? 2 : 1); ++k) {
      const double a = 2 * kPi * (i + 0.5 * k) / n, r = k == 0 ? radius : inner;
      out.push_back({r * std::cos(a), r * std::sin(a)});
    }
  return out;
}

/// A prism over a kite with two right angles; only the edge at the kite's tip and its ends are measured.
Shape wedge(int degrees, bool heldOut) {
  const double half = degrees * kPi / 360, leg = std::min(1.3, 1.6 * std::cos(half));
  const double x = leg * std::cos(half), y = leg * std::sin(half), back = leg / std::cos(half);
  const double shift = x;  // The origin lies between the right angles.
  Profile kite{.polygon = {{-shift, 0}, {x - shift, -y}, {back - shift, 0}, {x - shift, y}}};
  Shape shape = extrude(fmt::format("wedge{}", degrees), heldOut, kite, 0.7);
  shape.edges = {{Vec3d{-shift, 0, -0.7}, Vec3d{-shift, 0, 0.7}}};
  shape.corners = {{-shift, 0, -0.7}, {-shift, 0, 0.7}};
  return shape;
}

Shape sphere() {
  Shape shape = smoothShape("sphere", false, [](const Vec3d& p) { return length(p) - 0.9; });
  constexpr int kRings = 256, kAround = 512;
  const auto at = [](int i, int k) {
    const double a = kPi * i / kRings, b = 2 * kPi * k / kAround;
    return Vec3d{0.9 * std::sin(a) * std::cos(b), 0.9 * std::sin(a) * std::sin(b), -0.9 * std::cos(a)};
  };
  ShapeMesh& mesh = shape.mesh;
  for (int i = 1; i < kRings; ++i)
    for (int k = 0; k < kAround; ++k) mesh.points.push_back(at(i, k));
  const int bottom = static_cast<int>(mesh.points.size()), top = bottom + 1;
  mesh.points.push_back(at(0, 0));
  mesh.points.push_back(at(kRings, 0));
  for (int k = 0; k < kAround; ++k) {
    const int next = (k + 1) % kAround, last = (kRings - 2) * kAround;
    mesh.triangles.push_back({bottom, next, k});
    mesh.triangles.push_back({top, last + k, last + next});
    for (int i = 0; i + 2 < kRings; ++i) {
      const int a = i * kAround + k, b = i * kAround + next, c = a + kAround, d = b + kAround;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return shape;
}

Shape torus() {
  Shape shape =
      smoothShape("torus", false, [](const Vec3d& p) { return std::hypot(std::hypot(p.x, p.y) - 0.65, p.z) - 0.3; });
  constexpr int kAround = 512, kTube = 256;
  for (int i = 0; i < kAround; ++i)
    for (int k = 0; k < kTube; ++k) {
      const double a = 2 * kPi * i / kAround, b = 2 * kPi * k / kTube, r = 0.65 + 0.3 * std::cos(b);
      shape.mesh.points.push_back({r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b)});
      const int i1 = (i + 1) % kAround, k1 = (k + 1) % kTube;
      shape.mesh.triangles.push_back({i * kTube + k, i1 * kTube + k, i1 * kTube + k1});
      shape.mesh.triangles.push_back({i * kTube + k, i1 * kTube + k1, i * kTube + k1});
    }
  return shape;
}

}  // namespace

Shape smoothShape(std::string name, bool heldOut, std::function<double(const Vec3d&)> distance) {
  return {.name = std::move(name),
          .heldOut = heldOut,
          .distance = std::move(distance),
          .edges = {},
          .creases = {},
          .corners = {},
          .mesh = {}};
}

std::vector<Shape> makeShapes(double voxels) {
  std::vector<Shape> all;
  all.push_back(sphere());
  all.push_back(torus());
  all.push_back(extrude("box", false, {.polygon = rectangle(0.8, 0.6)}, 0.7));
  for (const int degrees : {60, 90, 120}) all.push_back(wedge(degrees, false));
  all.push_back(extrude("cylinder", false, {.radius = 0.7}, 0.6));
  all.push_back(revolve("cone", false, {{-0.7, -0.6}, {0.7, -0.6}, {0, 0.8}}));
  all.push_back(extrude("box_minus_cylinder", false, {.polygon = rectangle(0.8, 0.75), .hole = 0.45}, 0.5));
  constexpr double a = 0.9, b = 0.3;
  all.push_back(extrude("cross", false,
                        {.polygon = {{b, -b},
                                     {a, -b},
                                     {a, b},
                                     {b, b},
                                     {b, a},
                                     {-b, a},
                                     {-b, b},
                                     {-a, b},
                                     {-a, -b},
                                     {-b, -b},
                                     {-b, -a},
                                     {b, -a}}},
                        0.5));
  all.push_back(extrude("plate", false, {.polygon = rectangle(0.8, 0.7)}, 0.75 / voxels));

  for (const int degrees : {30, 45, 75, 105, 135, 150}) all.push_back(wedge(degrees, true));
  all.push_back(extrude("slab", true, {.polygon = rectangle(0.9, 0.5)}, 0.3));
  all.push_back(extrude("hexagon", true, {.polygon = regular(6, 0.8, 0)}, 0.55));
  all.push_back(extrude("star", true, {.polygon = regular(5, 0.95, 0.45)}, 0.45));
  all.push_back(extrude("bracket", true,
                        {.polygon = {{-0.3, -0.3}, {0.8, -0.3}, {0.8, 0.25}, {0.25, 0.25}, {0.25, 0.9}, {-0.3, 0.9}}},
                        0.5));
  all.push_back(extrude("tube", true, {.radius = 0.85, .hole = 0.5}, 0.5));
  all.push_back(revolve("frustum", true, {{-0.8, -0.5}, {0.8, -0.5}, {0.45, 0.5}, {-0.45, 0.5}}));
  return all;
}

Pose randomPose(unsigned seed, double size) {
  std::mt19937_64 random(seed * 7919ULL + 17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double scale = 1 / std::sqrt(w * w + x * x + y * y + z * z);
  w *= scale, x *= scale, y *= scale, z *= scale;
  const Mat3d rotation{{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                        Vec3d{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                        Vec3d{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
  return {size, rotation, {uniform(random), uniform(random), uniform(random)}};
}

}  // namespace pdc::eval
