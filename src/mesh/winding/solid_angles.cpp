#include "mesh/winding/solid_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesh/winding/lattice_line.h"

namespace pdc::detail {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;

/// Triangles this many of their radii away count together: their sum is then exact to 0.003 of a winding number.
constexpr double kFar = 3;

constexpr std::uint32_t kLeaf = 8;

Vec3d areaVector(const std::array<Vec3d, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]) * 0.5; }
Vec3d middleOf(const std::array<Vec3d, 3>& t) { return (t[0] + t[1] + t[2]) * (1.0 / 3); }

/// The share of the sphere that a triangle covers, signed (van Oosterom & Strackee 1983).
double solidAngle(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = std::abs(dot(a, cross(b, c)));
  const double flat = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  if (volume == 0 && flat >= 0) return 0;
  return -sideOfPlane(p, t) * 2 * std::atan2(volume, flat) / kSphere;
}

}  // namespace

SolidAngles::SolidAngles(const ClosedSurface& surface, std::vector<std::uint32_t> triangles)
    : mSurface(surface), mTriangles(std::move(triangles)) {
  if (mTriangles.empty()) return;
  mNodes.push_back({.first = 0, .count = static_cast<std::uint32_t>(mTriangles.size())});
  for (std::uint32_t node = 0; node < mNodes.size(); ++node) build(node);
}

void SolidAngles::build(std::uint32_t node) {
  summarise(mNodes[node]);
  const std::uint32_t first = mNodes[node].first, count = mNodes[node].count;
  if (count <= kLeaf) return;
  Box box = Box::empty();
  for (std::uint32_t i = first; i < first + count; ++i) box.include(middleOf(mSurface.points(mTriangles[i])));
  const Vec3d side = box.hi - box.lo;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : (side.y >= side.z ? 1 : 2);
  const auto begin = mTriangles.begin() + first, half = begin + count / 2;
  std::nth_element(begin, half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(middleOf(mSurface.points(a))[axis], a) < std::pair(middleOf(mSurface.points(b))[axis], b);
  });
  mNodes[node].child = static_cast<std::uint32_t>(mNodes.size());
  mNodes.push_back({.first = first, .count = count / 2});
  mNodes.push_back({.first = first + count / 2, .count = count - count / 2});
}

void SolidAngles::summarise(Node& node) const {
  const auto forEach = [&](auto&& visit) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(mSurface.points(mTriangles[i]));
  };
  Box box = Box::empty();
  Vec3d places{};
  forEach([&](const std::array<Vec3d, 3>& t) {
    const Vec3d normal = areaVector(t);
    node.area += length(normal);
    node.normal += normal;
    places += middleOf(t) * length(normal);
    for (const Vec3d& p : t) box.include(p);
  });
  node.middle = node.area > 0 ? places * (1 / node.area) : box.center();
  forEach([&](const std::array<Vec3d, 3>& t) {
    const Vec3d normal = areaVector(t), place = middleOf(t) - node.middle;
    for (int k = 0; k < 3; ++k) node.moment.row[k] += normal * place[k];
    for (const Vec3d& p : t) node.radius = std::max(node.radius, length(p - node.middle));
  });
}

double SolidAngles::below(std::uint32_t number, const Vec3d& p) const {
  const Node& node = mNodes[number];
  const Vec3d r = node.middle - p;
  const double d = length(r);
  if (d > kFar * node.radius) {
    // Of a triangle at r it is dot(normal, r) / |r|³, and this is differentiated by its place.
    const double cubed = d * d * d;
    const Vec3d turned{dot(node.moment.row[0], r), dot(node.moment.row[1], r), dot(node.moment.row[2], r)};
    const double trace = node.moment.row[0].x + node.moment.row[1].y + node.moment.row[2].z;
    return (dot(node.normal, r) / cubed + trace / cubed - 3 * dot(turned, r) / (cubed * d * d)) / kSphere;
  }
  if (node.child != 0) return below(node.child, p) + below(node.child + 1, p);
  double sum = 0;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    sum += solidAngle(p, mSurface.points(mTriangles[i]));
  return sum;
}

Vec3d SolidAngles::gradient(const Vec3d& p, double step) const {
  Vec3d result{};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d low = p, high = p;
    low[axis] -= step;
    high[axis] += step;
    const double difference = at(high) - at(low);
    result[axis] = (difference - std::round(difference)) / (2 * step);
  }
  return result;
}

double SolidAngles::bound(const Box& box, double limit) const {
  double sum = 0;
  if (!mNodes.empty()) addBound(0, box, limit, sum);
  return sum;
}

void SolidAngles::addBound(std::uint32_t number, const Box& box, double limit, double& sum) const {
  if (sum >= limit) return;
  const Node& node = mNodes[number];
  const double d = std::sqrt(box.squaredDistance(node.middle)) - node.radius;
  if (d > 2 * node.radius || (node.child == 0 && d > 0)) {
    sum += std::min(node.area / (kSphere * d * d), 0.5 * node.count);
  } else if (node.child == 0) {
    sum += 0.5 * node.count;
  } else {
    addBound(node.child, box, limit, sum);
    addBound(node.child + 1, box, limit, sum);
  }
}

}  // namespace pdc::detail
