#include "subdivide/refine_vertices.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "subdivide/vertex_sums.h"

namespace pdc::detail {
namespace {

/// What a vertex on a boundary or crease counts, and each of its two neighbours along it: those of cubic B-splines.
constexpr double kOnCrease = 0.75, kAlongCrease = 0.125;

template <typename Visit>
void forEachVertex(std::size_t n, BlockProgress& progress, const Visit& visit) {
  constexpr std::size_t kGrain = 4096;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) visit(static_cast<std::uint32_t>(i));
    progress.advance(r.size());
  });
}

/// The sharp edges at a vertex.
struct SharpEnds {
  std::size_t count = 0;
  std::uint32_t neighbour[2] = {0, 0};  ///< Of the first two.

  void add(std::uint32_t other) {
    if (count < 2) neighbour[count] = other;
    ++count;
  }
};

/// A vertex on a crease of its own, or where several meet.
template <typename Value>
Value onCrease(const SharpEnds& sharp, const Buffer<Value>& vertices, std::uint32_t v) {
  if (sharp.count > 2) return vertices[v];
  auto sum = startSum(vertices[v], kOnCrease);
  for (const std::uint32_t other : sharp.neighbour) sum.add(vertices[other], kAlongCrease);
  return sum.result();
}

template <typename Value>
Value loopVertex(const HalfEdges& mesh, LoopWeights weights, const Buffer<Value>& vertices, std::uint32_t v) {
  typename SumOf<Value>::Type sum(placeOf(vertices[v]));
  SharpEnds sharp;
  std::size_t n = 0;
  mesh.forEachSpoke(v, [&](std::uint32_t other, std::uint32_t edge, std::uint32_t) {
    sum.add(vertices[other], 1);
    if (mesh.sharp[edge] != 0) sharp.add(other);
    ++n;
  });
  if (sharp.count > 1) return onCrease(sharp, vertices, v);
  const double weight = loopWeight(n, weights);
  sum.scale(weight);
  sum.add(vertices[v], 1 - static_cast<double>(n) * weight);
  return sum.result();
}

template <typename Value>
Value loopEdge(const HalfEdges& mesh, const Buffer<Value>& vertices, std::uint32_t e) {
  constexpr double kEnd = 0.375, kOpposite = 0.125;
  const std::uint32_t h = mesh.half[e];
  const Value &a = vertices[mesh.origin[h]], &b = vertices[mesh.target(h)];
  const bool sharp = mesh.sharp[e] != 0;
  auto sum = startSum(a, sharp ? 0.5 : kEnd);
  sum.add(b, sharp ? 0.5 : kEnd);
  if (!sharp) {
    sum.add(vertices[mesh.origin[mesh.previous(h)]], kOpposite);
    sum.add(vertices[mesh.origin[mesh.previous(mesh.twin[h])]], kOpposite);
  }
  return sum.result();
}

/// \param refined holds the vertices of the faces already.
template <typename Value>
Value catmullClarkVertex(const HalfEdges& mesh, const Buffer<Value>& vertices, const Buffer<Value>& refined,
                         std::uint32_t v) {
  typename SumOf<Value>::Type sum(placeOf(vertices[v]));
  SharpEnds sharp;
  std::size_t count = 0;
  mesh.forEachSpoke(v, [&](std::uint32_t other, std::uint32_t edge, std::uint32_t h) {
    sum.add(vertices[other], 1);
    if (h != kNoHalfEdge) sum.add(refined[mesh.vertices + mesh.edges + mesh.face(h)], 1);
    if (mesh.sharp[edge] != 0) sharp.add(other);
    ++count;
  });
  if (sharp.count > 1) return onCrease(sharp, vertices, v);
  // (F + 2R + (n − 3) v) / n, where the middles R of the edges are taken apart.
  const auto n = static_cast<double>(count);
  sum.scale(1 / (n * n));
  sum.add(vertices[v], (n - 2) / n);
  return sum.result();
}

template <typename Value>
Value catmullClarkEdge(const HalfEdges& mesh, const Buffer<Value>& vertices, const Buffer<Value>& refined,
                       std::uint32_t e) {
  const std::uint32_t h = mesh.half[e];
  const bool sharp = mesh.sharp[e] != 0;
  auto sum = startSum(vertices[mesh.origin[h]], sharp ? 0.5 : 0.25);
  sum.add(vertices[mesh.target(h)], sharp ? 0.5 : 0.25);
  if (!sharp)
    for (const std::uint32_t side : {h, mesh.twin[h]})
      sum.add(refined[mesh.vertices + mesh.edges + mesh.face(side)], 0.25);
  return sum.result();
}

template <typename Value>
Value faceMean(const HalfEdges& mesh, const Buffer<Value>& vertices, std::uint32_t f) {
  const std::uint32_t begin = mesh.sides == 0 ? mesh.first[f] : f * static_cast<std::uint32_t>(mesh.sides);
  const std::uint32_t n = mesh.sides == 0 ? mesh.first[f + 1] - begin : static_cast<std::uint32_t>(mesh.sides);
  auto sum = startSum(vertices[mesh.origin[begin]], 1);
  for (std::uint32_t k = 1; k < n; ++k) sum.add(vertices[mesh.origin[begin + k]], 1);
  sum.scale(1.0 / n);
  return sum.result();
}

}  // namespace

double loopWeight(std::size_t neighbours, LoopWeights weights) {
  const auto n = static_cast<double>(neighbours);
  if (weights == LoopWeights::kWarren) return neighbours <= 3 ? 3.0 / 16 : 3 / (8 * n);
  const double c = 3 + 2 * std::cos(2 * std::numbers::pi / n);
  return (40 - c * c) / (64 * n);
}

template <typename Value>
Buffer<Value> refineLoop(const HalfEdges& mesh, LoopWeights weights, const Buffer<Value>& vertices,
                         BlockProgress& progress) {
  Buffer<Value> refined(mesh.vertices + mesh.edges);
  forEachVertex(mesh.vertices, progress, [&](std::uint32_t v) { refined[v] = loopVertex(mesh, weights, vertices, v); });
  forEachVertex(mesh.edges, progress,
                [&](std::uint32_t e) { refined[mesh.vertices + e] = loopEdge(mesh, vertices, e); });
  return refined;
}

template <typename Value>
Buffer<Value> refineCatmullClark(const HalfEdges& mesh, const Buffer<Value>& vertices, BlockProgress& progress) {
  Buffer<Value> refined(mesh.vertices + mesh.edges + mesh.faces);
  forEachVertex(mesh.faces, progress,
                [&](std::uint32_t f) { refined[mesh.vertices + mesh.edges + f] = faceMean(mesh, vertices, f); });
  forEachVertex(mesh.vertices, progress,
                [&](std::uint32_t v) { refined[v] = catmullClarkVertex(mesh, vertices, refined, v); });
  forEachVertex(mesh.edges, progress,
                [&](std::uint32_t e) { refined[mesh.vertices + e] = catmullClarkEdge(mesh, vertices, refined, e); });
  return refined;
}

template Buffer<Vec3d> refineLoop(const HalfEdges&, LoopWeights, const Buffer<Vec3d>&, BlockProgress&);
template Buffer<Gaussian> refineLoop(const HalfEdges&, LoopWeights, const Buffer<Gaussian>&, BlockProgress&);
template Buffer<Vec3d> refineCatmullClark(const HalfEdges&, const Buffer<Vec3d>&, BlockProgress&);
template Buffer<Gaussian> refineCatmullClark(const HalfEdges&, const Buffer<Gaussian>&, BlockProgress&);

}  // namespace pdc::detail
