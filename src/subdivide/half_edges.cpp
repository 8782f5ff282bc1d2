#include "subdivide/half_edges.h"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/faces.h"
#include "parallel/for_each_in_parallel.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 4096;

/// A half-edge by its ends, the lower first.
struct KeyedHalf {
  std::uint32_t low, high, half;
  friend auto operator<=>(const KeyedHalf&, const KeyedHalf&) = default;
};

void takeFaces(const Mesh& mesh, HalfEdges& result) {
  result.faces = faceCount(mesh);
  result.vertices = mesh.positions.size();
  std::size_t corners = 0;
  for (std::size_t f = 0; f < result.faces; ++f) corners += face(mesh, f).size();
  if (result.faces == 0) throw Error("the mesh has no faces");
  if (corners >= kNoHalfEdge) throw Error(fmt::format("the faces have {} corners; the limit is 2^32 - 2", corners));
  const bool triangles = mesh.triangles.size() == result.faces, quads = mesh.quads.size() == result.faces;
  result.sides = triangles ? 3 : quads ? 4 : 0;
  result.origin.reserve(corners);
  for (std::size_t f = 0; f < result.faces; ++f) {
    const auto named = face(mesh, f);
    for (std::size_t k = 0; k < named.size(); ++k)
      if (std::find(named.begin(), named.begin() + static_cast<std::ptrdiff_t>(k), named[k]) !=
          named.begin() + static_cast<std::ptrdiff_t>(k))
        throw Error(fmt::format("face {} names vertex {} twice", f, named[k]));
    if (result.sides == 0) {
      result.first.push_back(static_cast<std::uint32_t>(result.origin.size()));
      result.faceOf.insert(result.faceOf.end(), named.size(), static_cast<std::uint32_t>(f));
    }
    result.origin.insert(result.origin.end(), named.begin(), named.end());
  }
  if (result.sides == 0) result.first.push_back(static_cast<std::uint32_t>(result.origin.size()));
}

void joinTwins(HalfEdges& result) {
  const std::size_t n = result.size();
  std::vector<KeyedHalf> keyed(n);
  forEachInParallel(n, kGrain, [&](std::uint32_t h) {
    const std::uint32_t a = result.origin[h], b = result.target(h);
    keyed[h] = {std::min(a, b), std::max(a, b), h};
  });
  tbb::parallel_sort(keyed.begin(), keyed.end());
  result.twin.assign(n, kNoHalfEdge);
  result.edge.resize(n);
  for (std::size_t i = 0; i < n;) {
    const auto [low, high, h] = keyed[i];
    std::size_t end = i + 1;
    while (end < n && keyed[end].low == low && keyed[end].high == high) ++end;
    if (end - i > 2)
      throw Error(fmt::format("the edge of vertices {} and {} has {} faces, not 1 or 2", low, high, end - i));
    result.edge[h] = static_cast<std::uint32_t>(result.half.size());
    if (end - i == 2) {
      const std::uint32_t other = keyed[i + 1].half;
      if (result.origin[h] == result.origin[other])
        throw Error(fmt::format("both faces at the edge of vertices {} and {} run through it the same way", low, high));
      result.edge[other] = result.edge[h];
      result.twin[h] = other;
      result.twin[other] = h;
    }
    result.half.push_back(h);
    i = end;
  }
  result.edges = result.half.size();
}

void findOutgoing(HalfEdges& result) {
  std::vector<std::uint32_t> corners(result.vertices, 0);
  result.outgoing.assign(result.vertices, kNoHalfEdge);
  for (std::uint32_t h = 0; h < result.size(); ++h) {
    std::uint32_t& outgoing = result.outgoing[result.origin[h]];
    if (outgoing == kNoHalfEdge || result.twin[h] == kNoHalfEdge) outgoing = h;
    ++corners[result.origin[h]];
  }
  for (std::uint32_t v = 0; v < result.vertices; ++v) {
    std::uint32_t reached = 0;
    result.forEachSpoke(v, [&](std::uint32_t, std::uint32_t, std::uint32_t h) { reached += h != kNoHalfEdge; });
    if (reached != corners[v]) throw Error(fmt::format("the faces at vertex {} do not form one fan", v));
  }
}

/// Twice the area times the unit normal.
Vec3d areaVector(const HalfEdges& topology, const Mesh& mesh, std::uint32_t h) {
  const std::uint32_t begin = h;
  const Vec3d p0 = vecCast<double>(mesh.positions[topology.origin[begin]]);
  Vec3d sum{0, 0, 0};
  for (h = topology.next(h); topology.next(h) != begin; h = topology.next(h))
    sum += cross(vecCast<double>(mesh.positions[topology.origin[h]]) - p0,
                 vecCast<double>(mesh.positions[topology.target(h)]) - p0);
  return sum;
}

void markSharp(const Mesh& mesh, double creaseAngle, HalfEdges& result) {
  result.sharp.resize(result.edges);
  const double angle = creaseAngle * std::numbers::pi / 180;
  forEachInParallel(result.edges, kGrain, [&](std::uint32_t e) {
    const std::uint32_t h = result.half[e], other = result.twin[h];
    result.sharp[e] = other == kNoHalfEdge;
    if (other == kNoHalfEdge || creaseAngle >= 180) return;
    const Vec3d a = areaVector(result, mesh, h), b = areaVector(result, mesh, other);
    result.sharp[e] = std::atan2(length(cross(a, b)), dot(a, b)) > angle;
  });
}

/// What both kinds of refinement have in common: the edges that old ones are cut into, and what lies at their middles.
/// Edge e becomes 2e, at the origin of its lower half-edge, and 2e + 1.
HalfEdges startRefined(const HalfEdges& mesh, int sides, std::size_t faces, std::size_t innerEdges) {
  HalfEdges r;
  r.sides = sides;
  r.faces = faces;
  r.edges = 2 * mesh.edges + innerEdges;
  const std::size_t halves = faces * static_cast<std::size_t>(sides);
  r.origin.resize(halves);
  r.twin.resize(halves);
  r.edge.resize(halves);
  r.half.resize(r.edges);
  r.sharp.resize(r.edges);
  return r;
}

/// The edge between the origin of a half-edge and the vertex amid it.
std::uint32_t nearPart(const HalfEdges& mesh, std::uint32_t h) {
  const std::uint32_t e = mesh.edge[h];
  return 2 * e + (mesh.half[e] == h ? 0 : 1);
}
std::uint32_t farPart(const HalfEdges& mesh, std::uint32_t h) { return nearPart(mesh, h) ^ 1; }

void fillEdges(const HalfEdges& mesh, HalfEdges& r) {
  forEachInParallel(r.edges, kGrain,
                    [&](std::uint32_t e) { r.sharp[e] = e < 2 * mesh.edges ? mesh.sharp[e / 2] : std::uint8_t{0}; });
  forEachInParallel(r.size(), kGrain, [&](std::uint32_t h) {
    if (r.twin[h] == kNoHalfEdge || h < r.twin[h]) r.half[r.edge[h]] = h;
  });
}

}  // namespace

HalfEdges makeHalfEdges(const Mesh& mesh, double creaseAngle) {
  HalfEdges result;
  takeFaces(mesh, result);
  joinTwins(result);
  findOutgoing(result);
  markSharp(mesh, creaseAngle, result);
  return result;
}

RefinedCounts countRefined(const HalfEdges& mesh, bool triangles, int levels) {
  RefinedCounts n{static_cast<double>(mesh.vertices), static_cast<double>(mesh.edges), static_cast<double>(mesh.faces),
                  static_cast<double>(mesh.size())};
  for (int level = 0; level < levels; ++level) {
    if (triangles) {
      n = {n.vertices + n.edges, 2 * n.edges + 3 * n.faces, 4 * n.faces, 4 * n.halfEdges};
    } else {
      n = {n.vertices + n.edges + n.faces, 2 * n.edges + n.halfEdges, n.halfEdges, 4 * n.halfEdges};
    }
  }
  return n;
}

HalfEdges refineTriangles(const HalfEdges& mesh) {
  HalfEdges r = startRefined(mesh, 3, 4 * mesh.faces, 3 * mesh.faces);
  r.vertices = mesh.vertices + mesh.edges;
  const auto middle = [&](std::uint32_t h) { return static_cast<std::uint32_t>(mesh.vertices + mesh.edge[h]); };
  // The triangle at the corner where half-edge h begins.
  const auto corner = [](std::uint32_t h) { return 3 * (4 * (h / 3) + h % 3); };
  forEachInParallel(mesh.size(), kGrain, [&](std::uint32_t h) {
    const std::uint32_t before = mesh.previous(h), t = mesh.twin[h], s = mesh.twin[before];
    const std::uint32_t c = corner(h), inner = static_cast<std::uint32_t>(2 * mesh.edges) + h;
    const std::uint32_t amid = 3 * (4 * (h / 3) + 3) + h % 3;
    r.origin[c] = mesh.origin[h];
    r.origin[c + 1] = r.origin[amid] = middle(h);
    r.origin[c + 2] = middle(before);
    r.edge[c] = nearPart(mesh, h);
    r.edge[c + 1] = inner;
    r.edge[c + 2] = farPart(mesh, before);
    r.twin[c] = t == kNoHalfEdge ? kNoHalfEdge : corner(mesh.next(t)) + 2;
    r.twin[c + 2] = s == kNoHalfEdge ? kNoHalfEdge : corner(s);
    // From this edge's middle the triangle amid runs to that of the next: along the corner that lies between them.
    const std::uint32_t after = mesh.next(h);
    r.twin[amid] = corner(after) + 1;
    r.twin[corner(after) + 1] = amid;
    r.edge[amid] = static_cast<std::uint32_t>(2 * mesh.edges) + after;
  });
  fillEdges(mesh, r);
  r.outgoing.resize(r.vertices);
  forEachInParallel(mesh.vertices, kGrain, [&](std::uint32_t v) { r.outgoing[v] = corner(mesh.outgoing[v]); });
  forEachInParallel(mesh.edges, kGrain,
                    [&](std::uint32_t e) { r.outgoing[mesh.vertices + e] = corner(mesh.next(mesh.half[e])) + 2; });
  return r;
}

HalfEdges refinePolygons(const HalfEdges& mesh) {
  HalfEdges r = startRefined(mesh, 4, mesh.size(), mesh.size());
  r.vertices = mesh.vertices + mesh.edges + mesh.faces;
  const auto middle = [&](std::uint32_t h) { return static_cast<std::uint32_t>(mesh.vertices + mesh.edge[h]); };
  const auto inner = [&](std::uint32_t h) { return static_cast<std::uint32_t>(2 * mesh.edges) + h; };
  forEachInParallel(mesh.size(), kGrain, [&](std::uint32_t h) {
    const std::uint32_t before = mesh.previous(h), t = mesh.twin[h], s = mesh.twin[before];
    const std::uint32_t q = 4 * h;
    r.origin[q] = mesh.origin[h];
    r.origin[q + 1] = middle(h);
    r.origin[q + 2] = static_cast<std::uint32_t>(mesh.vertices + mesh.edges + mesh.face(h));
    r.origin[q + 3] = middle(before);
    r.edge[q] = nearPart(mesh, h);
    r.edge[q + 1] = inner(h);
    r.edge[q + 2] = inner(before);
    r.edge[q + 3] = farPart(mesh, before);
    r.twin[q] = t == kNoHalfEdge ? kNoHalfEdge : 4 * mesh.next(t) + 3;
    r.twin[q + 1] = 4 * mesh.next(h) + 2;
    r.twin[q + 2] = 4 * before + 1;
    r.twin[q + 3] = s == kNoHalfEdge ? kNoHalfEdge : 4 * s;
  });
  fillEdges(mesh, r);
  r.outgoing.resize(r.vertices);
  forEachInParallel(mesh.vertices, kGrain, [&](std::uint32_t v) { r.outgoing[v] = 4 * mesh.outgoing[v]; });
  forEachInParallel(mesh.edges, kGrain,
                    [&](std::uint32_t e) { r.outgoing[mesh.vertices + e] = 4 * mesh.next(mesh.half[e]) + 3; });
  forEachInParallel(mesh.faces, kGrain, [&](std::uint32_t f) {
    const std::uint32_t h = mesh.sides == 0 ? mesh.first[f] : f * static_cast<std::uint32_t>(mesh.sides);
    r.outgoing[mesh.vertices + mesh.edges + f] = 4 * h + 2;
  });
  return r;
}

Buffer<Triangle> refinedTriangles(const HalfEdges& mesh) {
  Buffer<Triangle> triangles(4 * mesh.faces);
  const auto middle = [&](std::uint32_t h) { return static_cast<std::uint32_t>(mesh.vertices + mesh.edge[h]); };
  forEachInParallel(mesh.faces, kGrain, [&](std::uint32_t f) {
    const std::uint32_t m[3] = {middle(3 * f), middle(3 * f + 1), middle(3 * f + 2)};
    for (std::uint32_t k = 0; k < 3; ++k)
      triangles[std::size_t{4} * f + k] = {mesh.origin[3 * f + k], m[k], m[(k + 2) % 3]};
    triangles[std::size_t{4} * f + 3] = {m[0], m[1], m[2]};
  });
  return triangles;
}

Buffer<Quad> refinedQuads(const HalfEdges& mesh) {
  Buffer<Quad> quads(mesh.size());
  const auto middle = [&](std::uint32_t h) { return static_cast<std::uint32_t>(mesh.vertices + mesh.edge[h]); };
  forEachInParallel(mesh.size(), kGrain, [&](std::uint32_t h) {
    quads[h] = {mesh.origin[h], middle(h), static_cast<std::uint32_t>(mesh.vertices + mesh.edges + mesh.face(h)),
                middle(mesh.previous(h))};
  });
  return quads;
}

}  // namespace pdc::detail
