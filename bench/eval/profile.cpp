#include "eval/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pdc::eval {
namespace {

constexpr double kPi = std::numbers::pi;
/// Segments of a full circle: chords within 2e-6 of the radius.
constexpr int kCircle = 1536;

double polygonDistance(const std::vector<Point2>& polygon, double x, double y) {
  double squared = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % n];
    const double ex = b.x - a.x, ey = b.y - a.y, px = x - a.x, py = y - a.y;
    const double t = std::clamp((px * ex + py * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    const double dx = px - t * ex, dy = py - t * ey;
    squared = std::min(squared, dx * dx + dy * dy);
    if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) * ex / ey) inside = !inside;
  }
  return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

void addCircle(std::vector<Segment>& edges, double r, double z) {
  const auto at = [&](int i) {
    const double a = 2 * kPi * i / kCircle;
    return Vec3d{r * std::cos(a), r * std::sin(a), z};
  };
  for (int i = 0; i < kCircle; ++i) edges.push_back({at(i), at(i + 1)});
}

/// Joins rings of points by quads, ring i to ring i + 1, and the last to the first if `closed`.
ShapeMesh joinRings(const std::vector<std::vector<Vec3d>>& rings, bool closed) {
  ShapeMesh mesh;
  const int n = static_cast<int>(rings[0].size()), count = static_cast<int>(rings.size());
  for (const auto& ring : rings) mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  for (int r = 0; r < (closed ? count : count - 1); ++r)
    for (int i = 0; i < n; ++i) {
      const int a = r * n + i, b = r * n + (i + 1) % n, c = (r + 1) % count * n + i,
                d = (r + 1) % count * n + (i + 1) % n;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

}  // namespace

double Profile::distance(double x, double y) const {
  const double outer = polygon.empty() ? std::hypot(x, y) - radius : polygonDistance(polygon, x, y);
  // The two outlines do not touch, so this is exact.
  return hole > 0 ? std::max(outer, hole - std::hypot(x, y)) : outer;
}

double Profile::outline(double angle) const {
  if (polygon.empty()) return radius;
  const double c = std::cos(angle), s = std::sin(angle);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % n];
    const double ex = b.x - a.x, ey = b.y - a.y, det = ex * s - ey * c;
    if (std::abs(det) < 1e-12) continue;
    const double t = (a.y * c - a.x * s) / det, along = (a.x + t * ex) * c + (a.y + t * ey) * s;
    if (t > -1e-9 && t < 1 + 1e-9 && along > 0) nearest = std::min(nearest, along);
  }
  return nearest;
}

std::vector<double> Profile::angles() const {
  std::vector<double> out;
  const auto wrap = [](double a) { return a < 0 ? a + 2 * kPi : a; };
  for (const Point2& p : polygon) out.push_back(wrap(std::atan2(p.y, p.x)));
  const std::size_t corners = out.size();
  // An angle close to a corner's would make slivers.
  for (int i = 0; i < kCircle; ++i) {
    const double a = 2 * kPi * i / kCircle;
    bool close = false;
    for (std::size_t k = 0; k < corners; ++k) close = close || std::abs(std::remainder(a - out[k], 2 * kPi)) < 1e-3;
    if (!close) out.push_back(a);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Shape extrude(std::string name, bool heldOut, const Profile& profile, double halfHeight) {
  Shape shape{.name = std::move(name),
              .heldOut = heldOut,
              .distance = {},
              .edges = {},
              .creases = {},
              .corners = {},
              .mesh = {}};
  shape.distance = [profile, halfHeight](const Vec3d& p) {
    const double d = profile.distance(p.x, p.y), h = std::abs(p.z) - halfHeight;
    return std::min(std::max(d, h), 0.0) + std::hypot(std::max(d, 0.0), std::max(h, 0.0));
  };
  const std::vector<Point2>& polygon = profile.polygon;
  for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % n];
    shape.edges.push_back({Vec3d{a.x, a.y, -halfHeight}, Vec3d{a.x, a.y, halfHeight}});
    for (const double z : {-halfHeight, halfHeight}) {
      shape.edges.push_back({Vec3d{a.x, a.y, z}, Vec3d{b.x, b.y, z}});
      shape.corners.push_back({a.x, a.y, z});
    }
  }
  for (const double z : {-halfHeight, halfHeight}) {
    if (polygon.empty()) addCircle(shape.edges, profile.radius, z);
    if (profile.hole > 0) addCircle(shape.edges, profile.hole, z);
  }
  shape.creases = shape.edges;

  std::vector<std::vector<Vec3d>> rings(4);
  for (const double a : profile.angles()) {
    const double r = profile.outline(a), c = std::cos(a), s = std::sin(a),
                 q = profile.hole > 0 ? profile.hole : 0.1 * r;
    rings[0].push_back({q * c, q * s, -halfHeight});
    rings[1].push_back({r * c, r * s, -halfHeight});
    rings[2].push_back({r * c, r * s, halfHeight});
    rings[3].push_back({q * c, q * s, halfHeight});
  }
  shape.mesh = joinRings(rings, profile.hole > 0);
  if (profile.hole > 0) return shape;
  const int n = static_cast<int>(rings[0].size()), low = 4 * n, high = low + 1;
  shape.mesh.points.push_back({0, 0, -halfHeight});
  shape.mesh.points.push_back({0, 0, halfHeight});
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    shape.mesh.triangles.push_back({low, j, i});
    shape.mesh.triangles.push_back({high, 3 * n + i, 3 * n + j});
  }
  return shape;
}

Shape revolve(std::string name, bool heldOut, const std::vector<Point2>& polygon) {
  Shape shape{.name = std::move(name),
              .heldOut = heldOut,
              .distance = {},
              .edges = {},
              .creases = {},
              .corners = {},
              .mesh = {}};
  shape.distance = [polygon](const Vec3d& p) { return polygonDistance(polygon, std::hypot(p.x, p.y), p.z); };
  // The half of the outline with r >= 0, from the lowest point on the axis to the highest.
  std::vector<Point2> half;
  for (const Point2& p : polygon)
    if (p.x >= 0) half.push_back(p);
  std::sort(half.begin(), half.end(),
            [](const Point2& a, const Point2& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  for (const Point2& p : half) {
    if (p.x > 0) addCircle(shape.edges, p.x, p.y);
    if (p.x == 0) shape.corners.push_back({0, 0, p.y});
  }
  shape.creases = shape.edges;

  const double low = half.front().y, high = half.back().y;
  std::vector<std::vector<Vec3d>> rings;
  for (const Point2& p : half) {
    if (p.x == 0) continue;
    rings.emplace_back();
    for (int i = 0; i < kCircle; ++i) {
      const double a = 2 * kPi * i / kCircle;
      rings.back().push_back({p.x * std::cos(a), p.x * std::sin(a), p.y});
    }
  }
  const int last = static_cast<int>(rings.size() - 1) * kCircle;
  shape.mesh = rings.size() > 1 ? joinRings(rings, false) : ShapeMesh{rings[0], {}};
  const int bottom = static_cast<int>(shape.mesh.points.size()), top = bottom + 1;
  shape.mesh.points.push_back({0, 0, low});
  shape.mesh.points.push_back({0, 0, high});
  for (int i = 0; i < kCircle; ++i) {
    const int j = (i + 1) % kCircle;
    shape.mesh.triangles.push_back({bottom, j, i});
    shape.mesh.triangles.push_back({top, last + i, last + j});
  }
  return shape;
}

}  // namespace pdc::eval
