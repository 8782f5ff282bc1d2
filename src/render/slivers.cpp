#include "render/slivers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/oriented_box.h"
#include "mesh/triangle_tree.h"

namespace pdc::detail {
namespace {

/// Slivers are drawn row by row where their boxes cover the picture more often than this.
constexpr double kCrowd = 16;
/// Ends of slivers closer than this become one, in pixels.
constexpr float kOccluderCell = 4;

TriangleCorners cornersOf(const ViewMesh& mesh, const Triangle& t) {
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

/// How many pixels of the picture a box covers.
double coveredPixels(const BoxF& box, int width, int height) {
  const auto part = [](float lo, float hi, int size) {
    return std::max(0.0, std::min(double(hi), double(size)) - std::max(double(lo), 0.0));
  };
  return part(box.lo.x, box.hi.x, width) * part(box.lo.y, box.hi.y, height);
}

/// For each vertex the one that stands for it: the first of those in its cell, but itself where it is a corner of
/// anything else than a sliver.
Buffer<std::uint32_t> unitedVertices(const ViewMesh& mesh, const DividedTriangles& divided) {
  Buffer<std::uint32_t> standsFor(mesh.positions.size());
  std::iota(standsFor.begin(), standsFor.end(), 0U);
  std::vector<bool> kept(mesh.positions.size(), false);
  for (const Triangle& t : divided.others)
    for (const std::uint32_t v : t) kept[v] = true;
  std::map<std::array<float, 3>, std::uint32_t> first;
  for (const std::uint32_t s : divided.slivers)
    for (const std::uint32_t v : mesh.triangles[s]) {
      if (kept[v]) continue;
      const Vec3f p = mesh.positions[v] * (1 / kOccluderCell);
      standsFor[v] = first.try_emplace({std::floor(p.x), std::floor(p.y), std::floor(p.z)}, v).first->second;
    }
  return standsFor;
}

Buffer<Triangle> makeOccluders(const ViewMesh& mesh, const DividedTriangles& divided) {
  const Buffer<std::uint32_t> standsFor = unitedVertices(mesh, divided);
  std::vector<Triangle> wide;
  for (const std::uint32_t s : divided.slivers) {
    Triangle t = mesh.triangles[s];
    for (std::uint32_t& v : t) v = standsFor[v];
    std::sort(t.begin(), t.end());
    if (t[0] != t[1] && t[1] != t[2]) wide.push_back(t);
  }
  std::sort(wide.begin(), wide.end());
  wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
  Buffer<Triangle> occluders = divided.others;
  occluders.insert(occluders.end(), wide.begin(), wide.end());
  return occluders;
}

}  // namespace

DividedTriangles divideTriangles(const ViewMesh& mesh, int width, int height) {
  DividedTriangles divided;
  double covered = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleCorners corners = cornersOf(mesh, mesh.triangles[i]);
    if (isSliver(corners)) {
      divided.slivers.push_back(static_cast<std::uint32_t>(i));
      covered += coveredPixels(boxOf(corners), width, height);
    } else {
      divided.others.push_back(mesh.triangles[i]);
      divided.otherNumbers.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (covered <= kCrowd * width * height) return {};
  divided.occluders = makeOccluders(mesh, divided);
  return divided;
}

Span rowSpan(const std::array<Vec3f, 3>& corners, double y) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Span span{kInfinity, -kInfinity};
  for (int k = 0; k < 3; ++k) {
    // From the lower to the upper end, so that both triangles at an edge get the same point.
    Vec3d a = vecCast<double>(corners[k]), b = vecCast<double>(corners[(k + 1) % 3]);
    if (b.y < a.y) std::swap(a, b);
    if (!(a.y <= y && y < b.y)) continue;
    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    span.begin = std::min(span.begin, x);
    span.end = std::max(span.end, x);
  }
  return span;
}

std::array<float, 3> planeWeights(const std::array<Vec3f, 3>& corners, double x, double y) {
  std::array<double, 3> areas{};
  for (int k = 0; k < 3; ++k) {
    const Vec3d a = vecCast<double>(corners[(k + 1) % 3]), b = vecCast<double>(corners[(k + 2) % 3]);
    areas[k] = (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
  }
  const double all = areas[0] + areas[1] + areas[2];
  std::array<float, 3> weights{};
  for (int k = 0; k < 3; ++k)
    weights[k] = all != 0 ? static_cast<float>(std::clamp(areas[k] / all, 0.0, 1.0)) : 1.0F / 3;
  return weights;
}

}  // namespace pdc::detail
