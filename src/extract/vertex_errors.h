#pragma once

#include <algorithm>
#include <cstdint>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/buffer.h"

namespace pdc::detail {

/// What the choice of a quad's diagonal needs to know of each vertex: its place and its quadric, in lattice units from
/// the centre of its cell.
struct VertexError {
  Vec3f x;
  SymMat3<float> A;
  Vec3f b;
};

/// The errors of a run of consecutive vertices that moves on: a ring, in which later ones take the place of earlier
/// ones.
class VertexErrors {
 public:
  /// \param longest run of vertices whose errors are needed at once.
  explicit VertexErrors(std::size_t longest) : mErrors(std::max<std::size_t>(longest, 1)) {}

  /// From now on `first` is the first of the run.
  void moveOn(std::uint64_t first) {
    while (first - mBase >= mErrors.size()) mBase += mErrors.size();
  }
  [[nodiscard]] VertexError& operator[](std::uint64_t vertex) { return mErrors[place(vertex)]; }
  [[nodiscard]] const VertexError& operator[](std::uint64_t vertex) const { return mErrors[place(vertex)]; }

 private:
  [[nodiscard]] std::uint64_t place(std::uint64_t vertex) const {
    const std::uint64_t i = vertex - mBase;
    return std::min(i, i - mErrors.size());  // The latter is huge before the ring's end.
  }

  Buffer<VertexError> mErrors;
  std::uint64_t mBase = 0;  ///< The vertex at place 0; the run does not begin before it.
};

}  // namespace pdc::detail
