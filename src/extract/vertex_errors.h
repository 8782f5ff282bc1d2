#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "pdc/math/sym_mat3.h"
#include "pdc/mesh/mesh.h"

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
  explicit VertexErrors(std::size_t longest)
      : mErrors(std::bit_ceil(std::max<std::size_t>(longest, 1))), mPlaces(mErrors.size() - 1) {}

  [[nodiscard]] VertexError& operator[](std::uint64_t vertex) { return mErrors[vertex & mPlaces]; }
  [[nodiscard]] const VertexError& operator[](std::uint64_t vertex) const { return mErrors[vertex & mPlaces]; }

 private:
  Buffer<VertexError> mErrors;
  std::uint64_t mPlaces;  ///< Their number, a power of two, less one.
};

}  // namespace pdc::detail
