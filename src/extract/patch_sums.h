#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "extract/crossing_planes.h"
#include "math/lane_loops.h"
#include "pdc/math/quadric_lanes.h"
#include "sample/patch_edges.h"

namespace pdc::detail {

/// What the crossings of sixteen patches, one per lane, sum up to: places p in lattice units from the low corner of the
/// patch's cell, which keeps their rounding at that of numbers up to one.
struct PatchSums {
  SymMat3Lanes<float> A;             ///< Σ rrᵀ; with noise Σ w (rrᵀ + σ² G).
  Vec3Lanes<float> b;                ///< Σ r (r·p); with noise Σ w (rrᵀ + σ² G) p.
  Vec3Lanes<float> place;            ///< Σ w p.
  alignas(64) float weight[kLanes];  ///< Σ w.
};

/// Where a patch's edges are found, and where their crossings lie.
struct PatchEdgeCode {
  /// From bit 0: the row of CrossingPlanes; then, for each axis, whether the edge lies at the far side of the cell, and
  /// whether it runs along.
  static constexpr unsigned kRowBits = 11, kRow = (1u << kRowBits) - 1;
  static constexpr unsigned far(int axis) { return 1u << (kRowBits + axis); }
  static constexpr unsigned along(int axis) { return 1u << (kRowBits + 3 + axis); }
  static_assert(HermiteBlock::kCapacity + 1 <= kRow);

  std::uint32_t slot, flags;  ///< `flags` leads to the row after that of the edge's number.
};

/// By edge of the cell; the last, of no edge, leads to the first row, which is zero.
inline constexpr auto kPatchEdgeCode = [] {
  constexpr std::size_t n = kCellEdge.size();
  std::array<PatchEdgeCode, n + 1> code{};
  for (std::size_t e = 0; e < n; ++e) {
    const CellEdge& edge = kCellEdge[e];
    code[e] = {static_cast<std::uint32_t>(edge.slot), 1 + PatchEdgeCode::along(edge.axis)};
    for (int axis = 0; axis < 3; ++axis)
      if ((edge.low >> axis & 1) != 0) code[e].flags |= PatchEdgeCode::far(axis);
  }
  code[n] = {EdgeIndex::kNoSlot, 0};
  return code;
}();

/// Sums up sixteen patches; those beyond the last repeat it. Must be compiled into a function of a SimdLevel.
template <bool kNoisy>
class PatchSummer {
 public:
  PatchSummer(const CrossingPlanes& crossings, const EdgeIndex& edges, const SymMat3<float>& G)
      : mCrossings(crossings), mNumber(edges.numbers()), mMetric(G) {}

  void run(std::span<const SurfacePatch> patches, PatchSums& sums) const {
    alignas(64) std::uint32_t code[kUsual][kLanes], rest[kLanes];
    unsigned more = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const SurfacePatch& patch = patches[std::min(lane, patches.size() - 1)];
      const std::uint16_t* number = mNumber + slotOf(patch);
      unsigned bits = patch.edges;
      for (auto& next : code) next[lane] = take(number, bits);
      rest[lane] = bits;
      more |= bits;
    }
    add<kUsual, true>(code, sums);
    while (more != 0) {
      more = 0;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const SurfacePatch& patch = patches[std::min(lane, patches.size() - 1)];
        code[0][lane] = take(mNumber + slotOf(patch), rest[lane]);
        more |= rest[lane];
      }
      add<1, false>(code, sums);
    }
  }

 private:
  /// Nearly all patches have three to six edges: adding nothing is cheaper than a branch that cannot be foreseen.
  static constexpr int kUsual = 6;

  /// Takes the first of a patch's edges out.
  static std::uint32_t take(const std::uint16_t* number, std::uint32_t& bits) {
    const PatchEdgeCode& code = kPatchEdgeCode[std::countr_zero(bits | 1u << kCellEdge.size())];
    bits &= bits - 1;
    return number[code.slot] + code.flags;
  }

  /// One of a patch's crossings.
  struct Crossing {
    float row[4][kLanes], noise[kNoisy ? 4 : 0][kLanes];
  };

  /// Adds `kCount` edges of each patch, to nothing at first.
  template <int kCount, bool kFirst>
  void add(const std::uint32_t (*code)[kLanes], PatchSums& s) const {
    // All of them, before any is used: what was just put together in memory comes late.
    alignas(64) Crossing crossing[kCount];
    for (int k = 0; k < kCount; ++k)
      for (int lane = 0; lane < kLanes; lane += 4) {
        const auto at = [&](int i) { return code[k][lane + i] & PatchEdgeCode::kRow; };
        transpose4({mCrossings.row(at(0)), mCrossings.row(at(1)), mCrossings.row(at(2)), mCrossings.row(at(3))},
                   &crossing[k].row[0][lane], kLanes);
        if constexpr (kNoisy)
          transpose4(
              {mCrossings.noise(at(0)), mCrossings.noise(at(1)), mCrossings.noise(at(2)), mCrossings.noise(at(3))},
              &crossing[k].noise[0][lane], kLanes);
      }
    const SymMat3<float> G = mMetric;
    forEachLane([&](int i) {
      SymMat3<float> A{};
      Vec3f b{}, sum{};
      float weight = 0;
      if constexpr (!kFirst) A = s.A.get(i), b = s.b.get(i), sum = s.place.get(i), weight = s.weight[i];
#pragma GCC unroll 6
      for (int k = 0; k < kCount; ++k) {
        const Crossing& c = crossing[k];
        const std::uint32_t flags = code[k][i];
        const float t = c.row[3][i];
        const auto place = [flags, t](int axis) {
          const float far = (flags & PatchEdgeCode::far(axis)) != 0 ? 1.0F : 0.0F;
          return (flags & PatchEdgeCode::along(axis)) != 0 ? t : far;
        };
        const Vec3f p{place(0), place(1), place(2)}, r{c.row[0][i], c.row[1][i], c.row[2][i]};
        if constexpr (kNoisy) {
          const float w = c.noise[0][i], variance = c.noise[1][i];
          A += outer(r) * w + G * variance;
          b += r * (w * dot(r, p)) + G * p * variance;
          sum += p * w;
          weight += w;
        } else {
          A += outer(r);
          b += r * dot(r, p);
          sum += p;
          weight += (flags & PatchEdgeCode::kRow) != 0 ? 1.0F : 0.0F;
        }
      }
      s.A.set(i, A);
      s.b.set(i, b);
      s.place.set(i, sum);
      s.weight[i] = weight;
    });
  }

  const CrossingPlanes& mCrossings;
  const std::uint16_t* mNumber;
  const SymMat3<float> mMetric;
};

}  // namespace pdc::detail
