#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "pdc/monitor.h"
#include "sample/block_index.h"
#include "sample/vdb/leaf_table.h"
#include "sample/vdb/value_reader.h"

namespace pdc::detail {

/// Finds tiles that lie on the other side of the isovalue than the background, beside blocks that do not: where a
/// surface can pass without touching any leaf.
template <typename TreeT>
class TileFaces {
 public:
  using Reader = ValueReader<typename TreeT::ValueType>;

  TileFaces(const TreeT& tree, const Reader& reader)
      : mTree(tree), mReader(reader), mBackground(reader.inside(tree.background())) {}

  /// Appends the blocks whose cells may hold such surface, in any order; may append a block more than once. \throws
  /// Error if a tile lies too far out.
  void find(const Monitor& monitor, std::vector<Coord>& blocks) const {
    findAroundLargeTiles(monitor, blocks);
    std::vector<const Parent*> parents;
    mTree.getNodes(parents);
    for (const Parent* p : parents) checkIndex(p->origin());
    tbb::enumerable_thread_specific<std::vector<Coord>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parents.size(), 4), [&](const auto& range) {
      monitor.throwIfStopped();
      Accessor accessor(mTree);
      for (std::size_t i = range.begin(); i != range.end(); ++i) findInParent(*parents[i], accessor, found.local());
    });
    for (const std::vector<Coord>& part : found) blocks.insert(blocks.end(), part.begin(), part.end());
  }

 private:
  using Grandparent = typename TreeT::RootNodeType::ChildNodeType;  ///< Of leaves.
  using Parent = typename Grandparent::ChildNodeType;
  using Accessor = openvdb::tree::ValueAccessor<const TreeT>;
  static constexpr int kTiles = 1 << Parent::LOG2DIM;  ///< Leaf-sized tiles per axis of a leaf's parent.

  /// Cells about the lattice edges that leave block b along `axis`.
  static void addCellsAt(const Coord& b, int axis, std::vector<Coord>& blocks) {
    for (int i = 0; i < 4; ++i) {
      Coord c = b;
      c[(axis + 1) % 3] -= i & 1;
      c[(axis + 2) % 3] -= i >> 1;
      blocks.push_back(c);
    }
  }

  /// Block b beside a tile, beyond its high or low side along `axis`. Cells beside a leaf are found from the leaf.
  void visit(const Coord& b, int axis, bool high, Accessor& accessor, std::vector<Coord>& blocks) const {
    const openvdb::Coord p(b[0] * kBlockSize, b[1] * kBlockSize, b[2] * kBlockSize);
    if (accessor.probeConstLeaf(p) != nullptr || mReader.inside(accessor.getValue(p)) != mBackground) return;
    Coord lower = b;
    lower[axis] -= high;
    addCellsAt(lower, axis, blocks);
  }

  /// Tiles of the root and of its children.
  void findAroundLargeTiles(const Monitor& monitor, std::vector<Coord>& blocks) const {
    Accessor accessor(mTree);
    for (auto tile = mTree.root().cbeginValueAll(); tile; ++tile)
      if (mReader.inside(*tile) != mBackground)
        findAround(openvdb::CoordBBox::createCube(tile.getCoord(), Grandparent::DIM), monitor, accessor, blocks);
    // By their tables: iterators take several times as long, and most trees have tens of thousands of entries here.
    std::vector<const Grandparent*> nodes;
    mTree.getNodes(nodes);
    for (const Grandparent* node : nodes) {
      const auto* table = node->getTable();
      for (openvdb::Index i = 0; i < Grandparent::NUM_VALUES; ++i) {
        if (node->isChildMaskOn(i) || mReader.inside(table[i].getValue()) == mBackground) continue;
        findAround(openvdb::CoordBBox::createCube(node->offsetToGlobalCoord(i), Parent::DIM), monitor, accessor,
                   blocks);
      }
    }
  }

  /// Around one tile.
  void findAround(const openvdb::CoordBBox& box, const Monitor& monitor, Accessor& accessor,
                  std::vector<Coord>& blocks) const {
    checkIndex(box.min());
    checkIndex(box.max());
    const Coord low = blockOf({box.min().x(), box.min().y(), box.min().z()});
    const Coord high = blockOf({box.max().x(), box.max().y(), box.max().z()});
    for (int axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        monitor.throwIfStopped();
        Coord from = low, to = high;
        from[axis] = to[axis] = upper ? high[axis] + 1 : low[axis] - 1;
        for (Coord b = from; b[0] <= to[0]; ++b[0])
          for (b[1] = from[1]; b[1] <= to[1]; ++b[1])
            for (b[2] = from[2]; b[2] <= to[2]; ++b[2]) visit(b, axis, upper, accessor, blocks);
      }
  }

  /// Sixteen leaf-sized places of a node in a row along z.
  using Row = std::uint16_t;
  static_assert(kTiles == 16);

  void findInParent(const Parent& node, Accessor& accessor, std::vector<Coord>& blocks) const {
    constexpr int n = kTiles;
    std::array<Row, n * n> background, other;  // Tiles of the background's side, and those of the other one.
    unsigned any = 0;
    for (int r = 0; r < n * n; ++r) {
      const auto leaves = node.getChildMask().template getWord<std::uint64_t>(static_cast<openvdb::Index>(r / 4));
      const unsigned tiles = static_cast<unsigned>(~leaves >> n * (r % 4)) & 0xFFFF;
      unsigned differs = 0;
      for (unsigned w = tiles; w != 0; w &= w - 1) {
        const int z = std::countr_zero(w);
        differs |= unsigned{mReader.inside(node.getTable()[n * r + z].getValue()) != mBackground} << z;
      }
      other[r] = static_cast<Row>(differs);
      background[r] = static_cast<Row>(tiles & ~differs);
      any |= other[r];
    }
    if (any == 0) return;
    const Coord origin = blockOf({node.origin().x(), node.origin().y(), node.origin().z()});
    for (int r = 0; r < n * n; ++r) {
      if (other[r] == 0) continue;
      const int x = r / n, y = r % n;
      const auto visitBeside = [&](int axis, int step, unsigned places) {
        for (unsigned w = places; w != 0; w &= w - 1) {
          Coord b{origin[0] + x, origin[1] + y, origin[2] + std::countr_zero(w)};
          b[axis] += step;
          visit(b, axis, step > 0, accessor, blocks);
        }
      };
      for (const int step : {-1, 1}) {
        // What lies beyond the node may be anything.
        const auto row = [&](int u, int there) {
          return u + step < 0 || u + step >= n ? ~0u : unsigned{background[there]};
        };
        visitBeside(0, step, other[r] & row(x, r + n * step));
        visitBeside(1, step, other[r] & row(y, r + step));
      }
      visitBeside(2, -1, other[r] & (unsigned{background[r]} << 1 | 1));
      visitBeside(2, 1, other[r] & (unsigned{background[r]} >> 1 | 1u << (n - 1)));
    }
  }

  const TreeT& mTree;
  const Reader& mReader;
  bool mBackground;
};

}  // namespace pdc::detail
