#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "pdc/math/vec3.h"

namespace pdc::detail {

/// A vertex whose faces may intersect others: it is outside its cell, or its cell is a strict one.
struct LooseVertex {
  std::uint64_t vertex;
  std::int32_t block;
  std::uint16_t cell;  ///< 64x + 8y + z.
  Vec3f place;         ///< In lattice units from the centre of the cell; at first where its quadric wants it.
  /// Where it is safe: in its cell, and in a strict cell among its own patch's crossings.
  Vec3f safe;
  /// Outward normals, in world space, of the planes that meet in a crease there; zero beyond the last, and where there
  /// is none.
  std::array<Vec3f, 4> creaseNormals{};
};

/// The loose vertex of that number, or null. \pre the list is sorted by vertex
inline const LooseVertex* findLoose(const std::vector<LooseVertex>& loose, std::uint64_t vertex) {
  const auto it = std::lower_bound(loose.begin(), loose.end(), vertex,
                                   [](const LooseVertex& l, std::uint64_t v) { return l.vertex < v; });
  return it != loose.end() && it->vertex == vertex ? &*it : nullptr;
}

/// A sign-changing lattice edge of a block, whose quad it stands for.
struct EdgeRef {
  std::int32_t block;
  std::uint16_t edge;  ///< 512 axis + 64x + 8y + z.

  [[nodiscard]] int axis() const { return edge >> 9; }
  [[nodiscard]] int x() const { return edge >> 6 & 7; }
  [[nodiscard]] int y() const { return edge >> 3 & 7; }
  [[nodiscard]] int z() const { return edge & 7; }
  friend auto operator<=>(const EdgeRef&, const EdgeRef&) = default;
};

/// What one thread found that needs a closer look.
struct Doubts {
  std::vector<LooseVertex> vertices;
  std::vector<EdgeRef> quads;  ///< None of whose diagonals passes the quick test.
  std::uint64_t forcedDiagonals = 0;

  void append(const Doubts& d) {
    vertices.insert(vertices.end(), d.vertices.begin(), d.vertices.end());
    quads.insert(quads.end(), d.quads.begin(), d.quads.end());
    forcedDiagonals += d.forcedDiagonals;
  }
};

}  // namespace pdc::detail
