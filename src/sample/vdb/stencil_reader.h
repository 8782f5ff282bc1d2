#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/float_lanes.h"
#include "math/lane_loops.h"
#include "sample/creases/distance_stencil.h"
#include "sample/stencils/gradient_stencil.h"
#include "sample/vdb/leaf_table.h"
#include "sample/vdb/value_reader.h"
#include "sample/vdb/value_rows.h"

namespace pdc::detail {

/// Reads the values about a block into stencils, from the 27 leaves or tiles at and around it.
template <typename TreeT>
class StencilReader {
 public:
  using ValueT = typename TreeT::ValueType;
  using Table = LeafTable<TreeT>;

  /// \param table must outlive this.
  StencilReader(const Table& table, const ValueReader<ValueT>& reader, const SlopeLimits& limits)
      : mTable(table), mReader(reader), mLimits(limits) {}

  /// Hints that read() of a gradient stencil will soon be called for a block. Fetches what no block before has touched:
  /// the block's own leaf and those above it.
  void prefetch(const Coord& block) const {
    using LeafT = typename TreeT::LeafNodeType;
    const typename Table::Around around(mTable, block);
    const auto fetch = [&](const typename Table::Place& place, std::size_t rows, std::size_t step) {
      if (place.leaf < 0 || mTable.values(place.leaf) == nullptr) return;
      constexpr std::size_t kLine = 64 / sizeof(ValueT);
      const ValueT* values = mTable.values(place.leaf);
      for (std::size_t i = 0; i < LeafT::SIZE; i += step)
        for (std::size_t k = i; k < i + rows; k += kLine) __builtin_prefetch(values + k);
    };
    constexpr std::size_t kRow = kBlockSize, kLayer = kBlockSize * kBlockSize;
    fetch(around(0, 0, 0), LeafT::SIZE, LeafT::SIZE);
    fetch(around(0, 0, 1), LeafT::SIZE, LeafT::SIZE);
    fetch(around(0, 1, 0), 2 * kRow, kLayer);
    fetch(around(1, 0, 0), 2 * kLayer, LeafT::SIZE);
  }

  /// Reads the rows that a block's crossings need.
  void read(const Coord& block, const EdgeIndex& edges, GradientStencil& stencil) const {
    const GradientStencilRows needed(edges);
    const typename Table::Around around(mTable, block);
    std::array<std::array<ValueRows<TreeT>, 3>, 9> parts;
    for (unsigned bits = needed.parts(); bits != 0; bits &= bits - 1) {
      const int part = std::countr_zero(bits);
      for (int z = 0; z < 3; ++z)
        if (z != 0 || needed.below()) parts[part][z].find(mTable, around(part / 3 - 1, part % 3 - 1, z - 1));
    }
    const ValueReader<ValueT> reader = mReader;  // A copy on the stack, which no store can change.
    const auto readRows = [&](auto below) {
      for (const std::uint8_t i : needed.rows()) {
        const auto [part, row] = kRowPlace[i];
        float* to = &stencil.value[GradientStencil::kPoints * i];
        if constexpr (decltype(below)::value) reader.template copy<1>(parts[part][0].row(row) + 7, to);
        reader.template copy<8>(parts[part][1].row(row), to + 1);
        reader.template copy<2>(parts[part][2].row(row), to + 9);
      }
    };
    withSimd(mLevel, [&] {
      if (needed.below()) {
        readRows(std::true_type{});
      } else {
        readRows(std::false_type{});
      }
    });
  }

  /// Reads the rows that the stencil asks for, times `scale`.
  void read(const Coord& block, float scale, DistanceStencil& stencil) const {
    constexpr int kBelow = DistanceStencil::kBelow, kAbove = DistanceStencil::kAbove;
    constexpr int kReach = DistanceStencil::kReach, kEndReach = kBlockPoints + kReach;
    constexpr std::array<int, 3> kFirst{-kReach, 0, kBlockSize}, kEnd{0, kBlockSize, kEndReach};
    const typename Table::Around around(mTable, block);
    const ValueReader<ValueT> reader = mReader;  // A copy on the stack, which no store can change.
    std::array<ValueRows<TreeT>, 3> parts;
    for (int px = 0; px < 3; ++px)
      for (int py = 0; py < 3; ++py) {
        for (int pz = 0; pz < 3; ++pz) parts[pz].find(mTable, around(px - 1, py - 1, pz - 1));
        for (int x = kFirst[px]; x < kEnd[px]; ++x)
          for (int y = kFirst[py]; y < kEnd[py]; ++y) {
            if ((stencil.rows[x + kReach] >> (y + kReach) & 1) == 0) continue;
            const int row = ValueRows<TreeT>::rowOf(x, y);
            float* to = &stencil.value[DistanceStencil::index(x, y, 0)];
            reader.template copy<kBelow>(parts[0].row(row) + (kBlockSize - kBelow), to - kBelow);
            reader.template copy<kBlockSize>(parts[1].row(row), to);
            reader.template copy<kAbove>(parts[2].row(row), to + kBlockSize);
          }
      }
    scaleKnown(mLimits, scale, stencil, mLevel);
  }

 private:
  /// Where a row of a gradient stencil lies: in which part (see GradientStencilRows), and there in which row.
  struct RowPlace {
    std::uint8_t part, row;
  };
  static constexpr auto kRowPlace = [] {
    std::array<RowPlace, GradientStencil::kPoints * GradientStencil::kPoints> places{};
    for (int i = 0; i < GradientStencil::kPoints * GradientStencil::kPoints; ++i) {
      const int x = i / GradientStencil::kPoints - 1, y = i % GradientStencil::kPoints - 1;
      places[i] = {static_cast<std::uint8_t>(3 * GradientStencil::part(x) + GradientStencil::part(y)),
                   static_cast<std::uint8_t>(ValueRows<TreeT>::rowOf(x, y))};
    }
    return places;
  }();

  const Table& mTable;
  ValueReader<ValueT> mReader;
  SlopeLimits mLimits;
  SimdLevel mLevel = bestSimdLevel();
};

}  // namespace pdc::detail
