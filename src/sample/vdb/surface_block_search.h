#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <utility>
#include <vector>

#include "pdc/monitor.h"
#include "pdc/sample/hermite_source.h"
#include "sample/stencils/block_parts.h"
#include "sample/vdb/grid_sampler.h"
#include "sample/vdb/leaf_signs.h"
#include "sample/vdb/leaf_table.h"
#include "sample/vdb/sort_blocks.h"
#include "sample/vdb/tile_faces.h"
#include "sample/vdb/value_reader.h"

namespace pdc::detail {

/// Finds the blocks of a tree that hold surface, and the signs of their points. Runs in parallel.
template <typename TreeT>
class SurfaceBlockSearch {
 public:
  using Table = LeafTable<TreeT>;
  using Reader = ValueReader<typename TreeT::ValueType>;

  /// What is searched, and how.
  struct Input {
    const TreeT& tree;
    const Table& table;
    const Reader& reader;
    const ValueReading& reading;
    const GridSampler* weight;  ///< See GridSampler::surfaceBlocks().
  };

  /// Reads the signs of all leaves. The input must outlive this. \throws Error for non-finite values that are not
  /// accepted.
  explicit SurfaceBlockSearch(const Input& input)
      : mTree(input.tree),
        mTable(input.table),
        mReader(input.reader),
        mWeight(input.weight),
        mOpen(input.reading.open),
        mLeaves(input.table, input.reader) {
    if (input.reading.acceptNonFinite) return;
    if (!mLeaves.allFinite() || nonFiniteTiles(input.tree).count > 0) requireFiniteVoxels(input.tree);
  }

  /// See HermiteSource::surfaceBlocks().
  [[nodiscard]] GridBlocks find(const Monitor& monitor) const {
    SurfaceBlocks out;
    out.open = mOpen;
    out.coords = mixedBlocks(monitor);
    out.signs.resize(out.coords.size());
    std::atomic<std::size_t> withoutData = 0;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.coords.size(), 64), [&](const auto& range) {
      monitor.throwIfStopped();
      std::size_t kept = 0;
      for (std::size_t i = range.begin(); i != range.end(); ++i) kept += readSigns(out.coords[i], out.signs[i]);
      withoutData += kept;
    });
    if (mOpen) dropBlocksWithoutCells(out);
    return {std::move(out), withoutData};
  }

 private:
  using Place = typename Table::Place;

  /// Every block whose 9×9×9 points are not all on one side, each once, sorted.
  [[nodiscard]] std::vector<Coord> mixedBlocks(const Monitor& monitor) const {
    std::vector<Coord> blocks;
    TileFaces<TreeT>(mTree, mReader).find(monitor, blocks);
    std::erase_if(blocks, [&](const Coord& b) { return !isMixed(b); });
    tbb::enumerable_thread_specific<std::vector<Coord>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mTable.size(), 256), [&](const auto& range) {
      monitor.throwIfStopped();
      std::vector<Coord>& local = found.local();
      for (std::size_t l = range.begin(); l != range.end(); ++l) {
        const Coord& b = mTable.coord(l);
        if (isMixed(b)) local.push_back(b);
        addTilesBelow(l, local);
      }
    });
    for (const std::vector<Coord>& part : found) blocks.insert(blocks.end(), part.begin(), part.end());
    sortUnique(blocks);
    return blocks;
  }

  /// A leaf's points are corners of cells of the seven blocks below it too. Adds those that are tiles, unless the
  /// leaf's points there are on the tile's side.
  void addTilesBelow(std::size_t leaf, std::vector<Coord>& blocks) const {
    const Coord& b = mTable.coord(leaf);
    const typename Table::Around around(mTable, b);
    for (int i = 1; i < kBlockParts; ++i) {
      const int dx = i >> 2, dy = i >> 1 & 1, dz = i & 1;
      const Place tile = around(-dx, -dy, -dz);
      if (tile.leaf >= 0) continue;
      const Side side = mLeaves.side(tile);
      if (mLeaves.side(leaf) == side || sideOfCorners(mLeaves.inside(leaf), i) == side) continue;
      blocks.push_back({b[0] - dx, b[1] - dy, b[2] - dz});
    }
  }

  [[nodiscard]] bool isMixed(const Coord& block) const {
    const typename Table::Around around(mTable, block);
    std::array<Place, kBlockParts> part;
    std::array<Side, kBlockParts> side;
    bool mixed = false;
    for (int i = 0; i < kBlockParts; ++i) {
      part[i] = around(i >> 2, i >> 1 & 1, i & 1);
      side[i] = mLeaves.side(part[i]);
      mixed = mixed || side[i] != side[0];
    }
    if (side[0] == Side::kBoth || !mixed) return side[0] == Side::kBoth;
    for (int i = 1; i < kBlockParts; ++i)
      if (side[i] != side[0] && (side[i] != Side::kBoth || sideOfCorners(mLeaves.inside(part[i].leaf), i) != side[0]))
        return true;
    return false;
  }

  /// \returns the number of the block's crossings that are kept without data.
  std::size_t readSigns(const Coord& block, BlockSigns& signs) const {
    const typename Table::Around around(mTable, block);
    std::array<CellMask, kBlockParts> inside, data;
    for (int i = 0; i < kBlockParts; ++i) {
      const Place place = around(i >> 2, i >> 1 & 1, i & 1);
      inside[i] = mLeaves.mask(place);
      if (mOpen || mWeight != nullptr) data[i] = pointsWithData(place, block, i);
    }
    joinParts(inside, signs.row);
    signs.cells = CellMask::all();
    if (!mOpen && mWeight == nullptr) return 0;
    BlockSigns known;
    joinParts(data, known.row);
    if (!mOpen) return crossingsToUnknown(signs.row, known.row);
    signs.cells = cellsWithAllCorners(known.row);
    return 0;
  }

  /// Points that are active, if the surface ends where activity does, and have a weight, if there are weights.
  [[nodiscard]] CellMask pointsWithData(const Place& place, const Coord& block, int part) const {
    CellMask points = mOpen ? activePoints(place, block, part) : CellMask::all();
    if (mWeight == nullptr) return points;
    const CellMask weighed =
        mWeight->positivePoints({block[0] + (part >> 2), block[1] + (part >> 1 & 1), block[2] + (part & 1)});
    for (int x = 0; x < kBlockSize; ++x) points.word[x] &= weighed.word[x];
    return points;
  }

  [[nodiscard]] CellMask activePoints(const Place& place, const Coord& block, int part) const {
    if (place.leaf < 0) {
      const openvdb::Coord origin((block[0] + (part >> 2)) * kBlockSize, (block[1] + (part >> 1 & 1)) * kBlockSize,
                                  (block[2] + (part & 1)) * kBlockSize);
      return mTree.isValueOn(origin) ? CellMask::all() : CellMask{};
    }
    CellMask m;
    const auto& mask = mTable.leaf(place.leaf).getValueMask();
    for (openvdb::Index w = 0; w < kBlockSize; ++w) m.word[w] = mask.template getWord<std::uint64_t>(w);
    return m;
  }

  const TreeT& mTree;
  const Table& mTable;
  const Reader& mReader;
  const GridSampler* mWeight;
  bool mOpen;
  LeafSigns<TreeT> mLeaves;
};

}  // namespace pdc::detail
