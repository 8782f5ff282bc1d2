#pragma once

#include <algorithm>
#include <cstdint>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {

/// What the choice of a quad's diagonal needs to know of each vertex: its place and its quadric, in lattice units from
/// the centre of its cell.
struct PlacedQuadric {
  Vec3f x;
  SymMat3<float> A;
  Vec3f b;
};

/// The quadrics of a run of consecutive vertices that moves on: a circular buffer, in which later ones take the place
/// of earlier ones.
class PlacedQuadrics {
 public:
  /// Where vertices have their places.
  struct CircularIndex {
    std::uint32_t size, base;  ///< The vertex at place 0; the run does not begin before it.

    [[nodiscard]] std::uint32_t place(std::uint32_t vertex) const {
      const std::uint32_t i = vertex - base, wrapped = i - size;  // The latter is huge before the ring's end.
      return i < wrapped ? i : wrapped;
    }
  };

  /// \param longest run of vertices whose quadrics are needed at once.
  explicit PlacedQuadrics(std::size_t longest)
      : mQuadrics(std::max<std::size_t>(longest, 1)), mIndex{static_cast<std::uint32_t>(mQuadrics.size()), 0} {}

  /// From now on `first` is the first of the run.
  void moveOn(std::uint64_t first) {
    while (static_cast<std::uint32_t>(first) - mIndex.base >= mIndex.size) mIndex.base += mIndex.size;
  }
  [[nodiscard]] PlacedQuadric& operator[](std::uint64_t vertex) {
    return mQuadrics[mIndex.place(static_cast<std::uint32_t>(vertex))];
  }
  /// Points to the quadrics of `count` vertices from `first` on if they lie in a row; otherwise null.
  [[nodiscard]] PlacedQuadric* run(std::uint64_t first, std::uint32_t count) {
    const std::uint32_t place = mIndex.place(static_cast<std::uint32_t>(first));
    return mIndex.size - place >= count ? &mQuadrics[place] : nullptr;
  }
  [[nodiscard]] const PlacedQuadric* data() const { return mQuadrics.data(); }
  [[nodiscard]] const CircularIndex& index() const { return mIndex; }

 private:
  Buffer<PlacedQuadric> mQuadrics;
  CircularIndex mIndex;
};

}  // namespace pdc::detail
