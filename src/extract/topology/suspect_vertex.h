#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "extract/topology/block_refs.h"
#include "pdc/math/vec3.h"

namespace pdc::detail {

/// A vertex whose faces may intersect others: it is outside its cell, or its cell is an ambiguous one.
struct SuspectVertex {
  std::uint64_t vertex;
  std::int32_t block;
  BlockCell cell;
  Vec3f place;  ///< In lattice units from the centre of the cell; at first where its quadric wants it.
  /// Where it is safe: in its cell, and in an ambiguous cell among its own patch's crossings.
  Vec3f safe;
  /// Outward normals, in world space, of the planes that meet in a crease there; zero beyond the last, and where there
  /// is none.
  std::array<Vec3f, 4> creaseNormals{};

  [[nodiscard]] bool onKnownCrease() const { return creaseNormals[0] != Vec3f{}; }
};

/// Finds suspect vertices by their numbers in the mesh.
class SuspectIndex {
 public:
  /// \param suspect sorted by vertex.
  explicit SuspectIndex(const std::vector<SuspectVertex>& suspect)
      : mWords(suspect.empty() ? 0 : suspect.back().vertex / 64 + 1) {
    for (const SuspectVertex& v : suspect) mWords[v.vertex / 64].bits |= std::uint64_t{1} << v.vertex % 64;
    std::size_t count = 0;
    for (Word& w : mWords) {
      w.before = count;
      count += static_cast<std::size_t>(std::popcount(w.bits));
    }
  }

  /// The vertex's place in the list, or -1.
  [[nodiscard]] std::ptrdiff_t find(std::uint64_t vertex) const {
    if (vertex / 64 >= mWords.size()) return -1;
    const Word& w = mWords[vertex / 64];
    const std::uint64_t bit = std::uint64_t{1} << vertex % 64;
    if ((w.bits & bit) == 0) return -1;
    return static_cast<std::ptrdiff_t>(w.before) + std::popcount(w.bits & (bit - 1));
  }

 private:
  struct Word {
    std::uint64_t bits = 0;  ///< One for each of 64 vertices.
    std::size_t before = 0;  ///< Suspect ones in earlier words.
  };
  std::vector<Word> mWords;
};

/// What may intersect other faces, as one thread found it.
struct Suspects {
  std::vector<SuspectVertex> vertices;
  std::vector<EdgeRef> quads;  ///< Neither diagonal passes the quick test.
  std::uint64_t forcedDiagonals = 0;
};

}  // namespace pdc::detail
