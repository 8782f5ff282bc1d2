#include "pdc/mesh/self_intersections.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"
#include "mesh/intersections/pair_search.h"
#include "mesh/triangle_pair.h"
#include "pdc/error.h"

namespace pdc {
namespace {

constexpr std::size_t kChunk = 4096;  // triangles

/// What is to be searched, and what is left out.
struct Candidates {
  Buffer<std::uint32_t> triangles;
  std::size_t degenerate = 0, nonFinite = 0;
};

enum class Kind { kSound, kDegenerate, kNonFinite };

Kind kindOf(const Mesh& mesh, std::size_t i) {
  const detail::TriangleCorners t = detail::corners(mesh, detail::triangle(mesh, i));
  if (!std::all_of(t.begin(), t.end(), detail::isFinite)) return Kind::kNonFinite;
  return detail::isDegenerate(t) ? Kind::kDegenerate : Kind::kSound;
}

Candidates candidatesOf(const Mesh& mesh) {
  const std::size_t count = detail::triangleCount(mesh);
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw Error(fmt::format("the mesh has {} triangles, more than 2^32 - 1", count));
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<std::array<std::size_t, 3>> kinds(chunks);
  const auto forEach = [&](std::size_t chunk, auto&& visit) {
    for (std::size_t i = kChunk * chunk; i < std::min(count, kChunk * (chunk + 1)); ++i) visit(i, kindOf(mesh, i));
  };
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    forEach(chunk, [&](std::size_t, Kind kind) { ++kinds[chunk][static_cast<std::size_t>(kind)]; });
  });

  Candidates result;
  std::vector<std::size_t> first(chunks + 1, 0);
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    first[chunk + 1] = first[chunk] + kinds[chunk][0];
    result.degenerate += kinds[chunk][1];
    result.nonFinite += kinds[chunk][2];
  }
  result.triangles.resize(first.back());
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    std::uint32_t* out = result.triangles.data() + first[chunk];
    forEach(chunk, [&](std::size_t i, Kind kind) {
      if (kind == Kind::kSound) *out++ = static_cast<std::uint32_t>(i);
    });
  });
  return result;
}

}  // namespace

SelfIntersections selfIntersections(const Mesh& mesh, const SelfIntersectionOptions& options, const Monitor& monitor) {
  detail::checkSizes(mesh, "selfIntersections");
  detail::checkIndices(mesh);
  monitor.throwIfStopped();
  Candidates candidates = candidatesOf(mesh);
  SelfIntersections result;
  result.degenerateTriangles = candidates.degenerate;
  result.nonFiniteTriangles = candidates.nonFinite;
  const std::size_t oneMore = options.maxPairs + (options.maxPairs < std::numeric_limits<std::size_t>::max());
  result.pairs = detail::intersectingPairs(mesh, std::move(candidates.triangles), oneMore, monitor);
  result.complete = result.pairs.size() <= options.maxPairs;
  if (!result.complete) result.pairs.resize(options.maxPairs);
  tbb::parallel_sort(result.pairs.begin(), result.pairs.end());
  return result;
}

}  // namespace pdc
