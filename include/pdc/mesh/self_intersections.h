#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pdc/mesh/mesh.h"
#include "pdc/monitor.h"

namespace pdc {

struct SelfIntersectionOptions {
  /// The search ends when it knows of more pairs than this. Bounds memory, 8 bytes a pair, and the time spent on a mesh
  /// of which every part lies in every other.
  std::size_t maxPairs = 1'000'000;
};

/// Triangles are numbered through the mesh: quad q is triangles 2 q and 2 q + 1, (v0, v1, v2) and (v0, v2, v3), and
/// triangle t is number 2 quads + t.
struct SelfIntersections {
  /// Sorted, each pair once with the smaller number first. If there are more than maxPairs, these are the first that
  /// were found.
  std::vector<std::array<std::uint32_t, 2>> pairs;
  bool complete = true;                 ///< False: there are more than maxPairs.
  std::size_t degenerateTriangles = 0;  ///< All their corners are on one line; they are in no pair.
  std::size_t nonFiniteTriangles = 0;   ///< They have a NaN or infinite coordinate and are in no pair.
};

/// The pairs of triangles that meet in more than the vertex or the edge that they share by index. A touch counts; so
/// does a triangle that is there twice. Exact: decided as if the coordinates were real numbers.
///
/// Runs in parallel; the result does not depend on the number of threads. For n triangles of a surface the time is that
/// of sorting them, slivers and any number of triangles at one vertex or edge included; n² if most pairs are so near
/// each other that boxes, turned to fit slivers, do not separate them. \throws Error if a face names a vertex that does
/// not exist, or for more than 2^32 - 1 triangles; Cancelled.
[[nodiscard]] SelfIntersections selfIntersections(const Mesh& mesh, const SelfIntersectionOptions& options = {},
                                                  const Monitor& monitor = {});

}  // namespace pdc
