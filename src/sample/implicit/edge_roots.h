#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pdc/field/field.h"
#include "sample/implicit/lattice_frame.h"

namespace pdc::detail {

/// Sign-changing lattice edges to be worked on together.
struct EdgeBatch {
  static constexpr std::size_t kCapacity = Field::kMaxBatch;

  std::array<std::array<double, kCapacity>, 3> low;  ///< Lattice coordinates of the lower ends, one array per axis.
  std::array<std::uint8_t, kCapacity> axis;          ///< Direction of the edge.
  std::size_t size = 0;
};

/// One world position per edge of a batch.
struct EdgePoints {
  std::array<std::array<double, EdgeBatch::kCapacity>, 3> p;

  [[nodiscard]] PointSpan span(std::size_t size) const { return {p[0].data(), p[1].data(), p[2].data(), size}; }
  /// Point `to` becomes the point at t on edge `edge`.
  void place(std::size_t to, const LatticeFrame& frame, const EdgeBatch& edges, std::size_t edge, double t);
};

/// Where the field changes sign along each edge: t[i] in [0, 1] from the lower end, within 2^-20 of a place where the
/// side (see isInside()) changes, whatever the function does there. Takes about 6 evaluations per edge where the
/// function is smooth, 22 at a jump, never more than 62. t[i] depends on edge i alone.
///
/// Inverse quadratic interpolation where it can be trusted, else bisection: T. R. Chandrupatla, A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using derivatives, Advances in
/// Engineering Software 28(3), 1997. The first point is the secant's.
void findEdgeRoots(const Field& field, const LatticeFrame& frame, const EdgeBatch& edges, double* t);

}  // namespace pdc::detail
