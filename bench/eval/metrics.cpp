#include "eval/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "eval/nearest.h"

namespace pdc::eval {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Spacing of the points that stand for an edge, in voxels.
constexpr double kStep = 0.2;

struct Corners {
  Vec3d p[3];
  [[nodiscard]] Vec3d normal() const { return cross(p[1] - p[0], p[2] - p[0]); }
  [[nodiscard]] Vec3d center() const { return (p[0] + p[1] + p[2]) * (1.0 / 3); }
};

std::vector<Triangle> allTriangles(const Mesh& mesh) {
  std::vector<Triangle> out(mesh.triangles.begin(), mesh.triangles.end());
  for (const Quad& q : mesh.quads) {
    out.push_back({q[0], q[1], q[2]});
    out.push_back({q[0], q[2], q[3]});
  }
  return out;
}

Corners corners(const Mesh& mesh, const Triangle& t) {
  const auto at = [&](int i) { return vecCast<double>(mesh.positions[t[static_cast<std::size_t>(i)]]); };
  return {{at(0), at(1), at(2)}};
}

template <typename Visit>
void forEachPoint(const Vec3d& a, const Vec3d& b, double step, const Visit& visit) {
  const int n = std::max(1, static_cast<int>(std::ceil(length(b - a) / step)));
  for (int i = 0; i < n; ++i) visit(a + (b - a) * ((i + 0.5) / n));
}

/// Points on edges, as many per length on curved ones, whose segments are short, as on straight ones.
std::vector<Vec3d> edgePoints(const std::vector<Segment>& edges, const Pose& pose) {
  std::vector<Vec3d> out;
  double gap = kStep;
  for (const Segment& s : edges) {
    const Vec3d a = pose.toWorld(s[0]), b = pose.toWorld(s[1]);
    const double l = length(b - a);
    if (l >= kStep) {
      forEachPoint(a, b, kStep, [&](const Vec3d& p) { out.push_back(p); });
    } else if ((gap += l) >= kStep) {
      out.push_back((a + b) * 0.5);
      gap = 0;
    }
  }
  return out;
}

Vec3d surfaceNormal(const Shape& shape, const Pose& pose, const Vec3d& p) {
  constexpr double kH = 1e-5;
  Vec3d g;
  for (int i = 0; i < 3; ++i) {
    Vec3d lo = p, hi = p;
    lo[i] -= kH;
    hi[i] += kH;
    g[i] = shape.distance(pose.toShape(hi)) - shape.distance(pose.toShape(lo));
  }
  return g * (1 / length(g));
}

void measureVertices(const Mesh& mesh, const Shape& shape, const Pose& pose, double fromX, Figures& f) {
  const std::vector<double> errors = vertexErrors(mesh, shape, pose);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(double{mesh.positions[i].x} > fromX)) continue;
    sum += errors[i] * errors[i];
    count += 1;
    f.vertexMax = std::max(f.vertexMax, errors[i]);
  }
  if (count > 0) f.vertexRms = std::sqrt(sum / count);
}

void measureNormals(const std::vector<Triangle>& triangles, const Mesh& mesh, const Shape& shape, const Pose& pose,
                    Figures& f) {
  Nearest creases(Figures::kAway);
  for (const Segment& s : shape.creases) creases.add({pose.toWorld(s[0]), pose.toWorld(s[1]), pose.toWorld(s[1])});
  for (const Vec3d& c : shape.corners) creases.add({pose.toWorld(c), pose.toWorld(c), pose.toWorld(c)});
  std::vector<double> angles;
  for (const Triangle& t : triangles) {
    const Corners c = corners(mesh, t);
    const Vec3d n = c.normal(), p = c.center();
    if (length(n) == 0 || creases.distance(p) < Figures::kAway) continue;
    const Vec3d truth = surfaceNormal(shape, pose, p);
    angles.push_back(std::atan2(length(cross(n, truth)), dot(n, truth)) / kDegree);
  }
  if (angles.empty()) return;
  const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(angles.size() - 1));
  std::nth_element(angles.begin(), angles.begin() + at, angles.end());
  f.normalP99 = angles[static_cast<std::size_t>(at)];
}

/// The mesh's edges between faces that differ by more than kSharp.
std::vector<Segment> sharpEdges(const std::vector<Triangle>& triangles, const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> first;
  std::vector<Segment> sharp;
  for (const Triangle& t : triangles) {
    Vec3d n = corners(mesh, t).normal();
    const double l = length(n);
    if (l > 0) n *= 1 / l;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto e = std::minmax(t[i], t[(i + 1) % 3]);
      const auto [it, fresh] = first.try_emplace({e.first, e.second}, n);
      if (!fresh && dot(it->second, n) < std::cos(Figures::kSharp * kDegree))
        sharp.push_back({vecCast<double>(mesh.positions[e.first]), vecCast<double>(mesh.positions[e.second])});
    }
  }
  return sharp;
}

double edgeF1(const std::vector<Segment>& sharp, const std::vector<Vec3d>& truth, const Shape& shape,
              const Pose& pose) {
  Nearest creases(1), found(1);
  for (const Segment& s : shape.creases) creases.add({pose.toWorld(s[0]), pose.toWorld(s[1]), pose.toWorld(s[1])});
  std::size_t points = 0, right = 0, hit = 0;
  for (const Segment& s : sharp) {
    found.add({s[0], s[1], s[1]});
    forEachPoint(s[0], s[1], kStep, [&](const Vec3d& p) {
      ++points;
      right += creases.distance(p) < Figures::kNear;
    });
  }
  for (const Vec3d& p : truth) hit += found.distance(p) < Figures::kNear;
  if (right == 0 || hit == 0) return 0;
  const double precision = static_cast<double>(right) / static_cast<double>(points),
               recall = static_cast<double>(hit) / static_cast<double>(truth.size());
  return 2 * precision * recall / (precision + recall);
}

/// The place of each value when they are sorted; equal ones keep their order.
std::vector<double> places(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t k) { return values[i] < values[k]; });
  std::vector<double> out(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<double>(i);
  return out;
}

}  // namespace

std::vector<double> vertexErrors(const Mesh& mesh, const Shape& shape, const Pose& pose) {
  std::vector<double> errors;
  for (const Vec3f& v : mesh.positions)
    errors.push_back(std::abs(shape.distance(pose.toShape(vecCast<double>(v)))) * pose.size);
  return errors;
}

double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> u = places(a), v = places(b);
  const double mean = (static_cast<double>(a.size()) - 1) / 2;
  double both = 0, own = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += (u[i] - mean) * (v[i] - mean);
    own += (u[i] - mean) * (u[i] - mean);
  }
  return own > 0 ? both / own : 0;
}

Figures measureEdges(const Mesh& mesh, const Shape& shape, const Pose& pose, Part part) {
  Figures f;
  const double toX = part == Part::kHalves ? pose.offset.x : std::numeric_limits<double>::infinity();
  const std::vector<Triangle> triangles = allTriangles(mesh);
  Nearest surface(Figures::kFar);
  for (const Triangle& t : triangles) {
    const Corners c = corners(mesh, t);
    surface.add({c.p[0], c.p[1], c.p[2]});
  }
  std::vector<Vec3d> truth = edgePoints(shape.edges, pose);
  std::erase_if(truth, [&](const Vec3d& p) { return !(p.x < toX); });
  double sum = 0;
  for (const Vec3d& p : truth) {
    const double d = surface.distance(p);
    sum += d * d;
    f.edgeMax = std::max(f.edgeMax, d);
  }
  if (!truth.empty()) f.edgeRms = std::sqrt(sum / static_cast<double>(truth.size()));
  for (const Vec3d& c : shape.corners)
    if (pose.toWorld(c).x < toX) f.cornerMax = std::max(f.cornerMax, surface.distance(pose.toWorld(c)));
  f.edgeF1 = edgeF1(sharpEdges(triangles, mesh), truth, shape, pose);
  return f;
}

Figures measure(const Mesh& mesh, const Shape& shape, const Pose& pose, Part part) {
  const double fromX = part == Part::kHalves ? pose.offset.x : -std::numeric_limits<double>::infinity();
  Figures f;
  if (!shape.edges.empty() || !shape.corners.empty()) f = measureEdges(mesh, shape, pose, part);
  measureVertices(mesh, shape, pose, fromX, f);
  measureNormals(allTriangles(mesh), mesh, shape, pose, f);
  return f;
}

}  // namespace pdc::eval
