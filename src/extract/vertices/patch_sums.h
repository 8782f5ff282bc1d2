#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "extract/topology/cell_numbers.h"
#include "extract/topology/patch_list.h"
#include "extract/vertices/crossing_planes.h"
#include "math/float_lanes.h"
#include "sample/cell_edges.h"

namespace pdc::detail {

/// What the crossings of sixteen patches, one per lane, sum up to: places p in lattice units from the low corner of the
/// patch's cell, which keeps their rounding at that of numbers up to one.
struct PatchSumLanes {
  alignas(64) float row[16][kLanes];  ///< In the order of PatchSums::Row.

  [[nodiscard]] SymMat3<float> A(int i) const {
    return {row[0][i], row[1][i], row[2][i], row[3][i], row[4][i], row[5][i]};
  }
  [[nodiscard]] float weight(int i) const { return row[6][i]; }
  [[nodiscard]] Vec3f b(int i) const { return {row[8][i], row[9][i], row[10][i]}; }
  [[nodiscard]] Vec3f place(int i) const { return {row[11][i], row[12][i], row[13][i]}; }
};

/// Sums over the crossings of each of a block's patches: A = Σ rrᵀ, b = Σ rrᵀp, Σ p and their number; with noise
/// A = Σ w (rrᵀ + σ² G), b = Σ w (rrᵀ + σ² G) p, Σ w p and Σ w. Each crossing is added to the cells about it, in the
/// order of the crossings. Its functions must be compiled into a function of a SimdLevel.
class PatchSums {
 public:
  /// \param G where crossings have noise: see CellMetric.
  template <bool kNoisy>
  void add(const PatchList& patches, const CrossingPlanes& crossings, const EdgeIndex& edges, const SymMat3<float>& G) {
    mRow.resize(std::max(mRow.size(), patches.size() + 1));
    std::fill_n(mRow.begin(), patches.size() + 1, Row{});
    mNumber.clear();
    for (std::size_t i = 0; i < patches.size(); ++i) mNumber.set(patches[i].cell, static_cast<std::uint16_t>(i + 1));
    for (const std::uint32_t i : patches.multiVertex()) mNumber.set(patches[i].cell, 0);
    const Terms<kNoisy> terms(crossings, G);
    addAxis<kAxisX>(terms, edges);
    addAxis<kAxisY>(terms, edges);
    addAxis<kAxisZ>(terms, edges);
    for (const std::uint32_t i : patches.multiVertex())
      forEachEdge(patches[i], edges, [&](int e, int number) { addTo(mRow[i + 1], terms, e, number); });
    turnIntoLanes(patches.size());
  }

  /// The sums of patch `first`, a multiple of kLanes, and of those that follow; lanes beyond the last repeat it.
  [[nodiscard]] const PatchSumLanes& lanes(std::size_t first) const { return mLanes[first / kLanes]; }

 private:
  /// (Axx, Axy, Axz, Ayy, Ayz, Azz, Σw, 0), (b, Σwp, 0, 0).
  struct alignas(64) Row {
    Float8 A, b;
  };

  /// What crossings add to a cell.
  template <bool kNoisy>
  class Terms {
   public:
    Terms(const CrossingPlanes& crossings, const SymMat3<float>& G)
        : mCrossings(crossings), mG{G.xx, G.xy, G.xz, G.yy, G.yz, G.zz, 0, 0} {}

    void getA(int edge, Float8& A) const {
      const Float4 r = loadFloat4(mCrossings.row(edge)), one{1, 0, 0, 0};
      A = __builtin_shufflevector(r, one, 0, 0, 0, 1, 1, 2, 4, 5) *
          __builtin_shufflevector(r, one, 0, 1, 2, 1, 2, 2, 4, 5);
      if constexpr (kNoisy) {
        const float* noise = mCrossings.noise(edge);
        A = A * noise[0] + mG * noise[1];
      }
    }
    [[nodiscard]] float t(int edge) const { return mCrossings.t(edge); }

   private:
    const CrossingPlanes& mCrossings;
    const Float8 mG;
  };

  // Vectors go by reference: how wide ones are passed by value depends on the instruction set.

  /// What a step along an axis adds to b and Σwp: a column of A, and Σw, which is entry 6 of A; entry 7 is zero.
  template <Axis axis>
  static void getStep(const Float8& A, Float8& step) {
    if constexpr (axis == kAxisX) step = __builtin_shufflevector(A, A, 0, 1, 2, 6, 7, 7, 7, 7);
    if constexpr (axis == kAxisY) step = __builtin_shufflevector(A, A, 1, 3, 4, 7, 6, 7, 7, 7);
    if constexpr (axis == kAxisZ) step = __builtin_shufflevector(A, A, 2, 4, 5, 7, 7, 6, 7, 7);
  }

  static void add(Row& row, const Float8& A, const Float8& b) {
    row.A += A;
    row.b += b;
  }

  template <Axis axis, typename T>
  void addAxis(const T& terms, const EdgeIndex& edges) {
    constexpr Axis u = nextAxis(axis), v = previousAxis(axis);
    for (int i = edges.begin(axis); i < edges.begin(axis + 1); ++i) {
      const std::uint16_t* cell = mNumber.at(edges.points()[i]);
      Float8 A, low, alongU, alongV;
      terms.getA(i, A);
      getStep<axis>(A, low);
      getStep<u>(A, alongU);
      getStep<v>(A, alongV);
      low *= terms.t(i);
      const Float8 farU = low + alongU, farV = low + alongV, far = farU + alongV;
      add(mRow[cell[0]], A, low);
      add(mRow[cell[-CellNumbers::kStep[u]]], A, farU);
      add(mRow[cell[-CellNumbers::kStep[v]]], A, farV);
      add(mRow[cell[-CellNumbers::kStep[u] - CellNumbers::kStep[v]]], A, far);
    }
  }

  /// Adds edge e of a cell, whose number is `number`.
  template <typename T>
  static void addTo(Row& row, const T& terms, int e, int number) {
    Float8 A, along[3];
    terms.getA(number, A);
    getStep<kAxisX>(A, along[kAxisX]);
    getStep<kAxisY>(A, along[kAxisY]);
    getStep<kAxisZ>(A, along[kAxisZ]);
    const Axis axis = kCellEdge[e].axis;
    Float8 b = along[axis] * terms.t(number);
    if ((e & 1) != 0) b += along[nextAxis(axis)];
    if ((e & 2) != 0) b += along[previousAxis(axis)];
    add(row, A, b);
  }

  /// All of them before any is used: what was just put together in memory comes late.
  void turnIntoLanes(std::size_t count) {
    mLanes.resize(std::max(mLanes.size(), batchCount(count)));
    for (std::size_t first = 0; first < kLanes * batchCount(count); first += 4) {
      const auto from = [&](std::size_t i) {
        return reinterpret_cast<const float*>(&mRow[std::min(first + i, count - 1) + 1]);
      };
      const std::array<const float*, 4> row{from(0), from(1), from(2), from(3)};
      PatchSumLanes& lanes = mLanes[first / kLanes];
      for (std::size_t part = 0; part < 16; part += 4)
        transpose4({row[0] + part, row[1] + part, row[2] + part, row[3] + part}, &lanes.row[part][first % kLanes],
                   kLanes);
    }
  }

  CellNumbers mNumber;
  std::vector<Row> mRow;  ///< The first takes what belongs to no patch; the patches follow.
  std::vector<PatchSumLanes> mLanes;
};

}  // namespace pdc::detail
