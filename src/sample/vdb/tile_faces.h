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

  /// How many crossings such surface has about tiles that are larger than leaves, roughly: each face is judged by what
  /// lies beyond its middle. \throws Error if a tile lies too far out.
  [[nodiscard]] double forecast() const {
    Accessor accessor(mTree);
    double crossings = 0;
    forEachLargeTile([&](const openvdb::CoordBBox& box) {
      checkIndex(box.min());
      checkIndex(box.max());
      const int dim = box.dim().x();
      for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
          openvdb::Coord p = box.min().offsetBy(dim / 2);
          p[axis] = upper ? box.max()[axis] + 1 : box.min()[axis] - 1;
          if (mReader.inside(accessor.getValue(p)) == mBackground)
            crossings += static_cast<double>(dim) * static_cast<double>(dim);
        }
    });
    return crossings;
  }

 private:
  using Grandparent = typename TreeT::RootNodeType::ChildNodeType;
  using Parent = typename Grandparent::ChildNodeType;
  using Accessor = openvdb::tree::ValueAccessor<const TreeT>;
  static constexpr int kTiles = 1 << Parent::LOG2DIM;  ///< Leaf-sized tiles per axis of a leaf's parent.

  /// Adds the blocks of the cells about the lattice edges that leave block b along `axis`.
  static void addCellsAt(const Coord& b, int axis, std::vector<Coord>& blocks) {
    for (int i = 0; i < 4; ++i) {
      Coord c = b;
      c[(axis + 1) % 3] -= i & 1;
      c[(axis + 2) % 3] -= i >> 1;
      blocks.push_back(c);
    }
  }

  /// Looks at block b beside a tile, beyond its high or low side along `axis`. Cells beside a leaf are found from the
  /// leaf.
  void visit(const Coord& b, int axis, bool high, Accessor& accessor, std::vector<Coord>& blocks) const {
    const openvdb::Coord p(b[0] * kBlockSize, b[1] * kBlockSize, b[2] * kBlockSize);
    if (accessor.probeConstLeaf(p) != nullptr || mReader.inside(accessor.getValue(p)) != mBackground) return;
    Coord lower = b;
    lower[axis] -= high;
    addCellsAt(lower, axis, blocks);
  }

  /// Looks around the tiles of the root and of its children.
  void findAroundLargeTiles(const Monitor& monitor, std::vector<Coord>& blocks) const {
    Accessor accessor(mTree);
    forEachLargeTile([&](const openvdb::CoordBBox& box) { findAround(box, monitor, accessor, blocks); });
  }

  /// Calls visit(box) for the tiles of the root and of its children that are on the other side.
  template <typename Visit>
  void forEachLargeTile(const Visit& visit) const {
    for (auto tile = mTree.root().cbeginValueAll(); tile; ++tile)
      if (mReader.inside(*tile) != mBackground)
        visit(openvdb::CoordBBox::createCube(tile.getCoord(), Grandparent::DIM));
    // Iterators take several times as long as tables, and most trees have tens of thousands of entries here.
    std::vector<const Grandparent*> nodes;
    mTree.getNodes(nodes);
    for (const Grandparent* node : nodes) {
      const auto* table = node->getTable();
      for (openvdb::Index i = 0; i < Grandparent::NUM_VALUES; ++i) {
        if (node->isChildMaskOn(i) || mReader.inside(table[i].getValue()) == mBackground) continue;
        visit(openvdb::CoordBBox::createCube(node->offsetToGlobalCoord(i), Parent::DIM));
      }
    }
  }

  /// Visits the blocks around one tile.
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

  /// The leaf-sized places of a node in rows of sixteen along z, row 16x + y, a bit each.
  using Rows = std::array<std::uint16_t, kTiles * kTiles>;
  static_assert(kTiles == 16);

  /// Which places of a node are tiles on the background's side, and which are tiles on the other one.
  struct TileSides {
    Rows background, other;
    bool anyOther;
  };
  TileSides findSides(const Parent& node) const {
    TileSides sides;
    unsigned any = 0;
    for (int r = 0; r < kTiles * kTiles; ++r) {
      const auto leaves = node.getChildMask().template getWord<std::uint64_t>(static_cast<openvdb::Index>(r / 4));
      const unsigned tiles = static_cast<unsigned>(~leaves >> kTiles * (r % 4)) & 0xFFFF;
      unsigned other = 0;
      for (unsigned w = tiles; w != 0; w &= w - 1) {
        const int z = std::countr_zero(w);
        other |= unsigned{mReader.inside(node.getTable()[kTiles * r + z].getValue()) != mBackground} << z;
      }
      sides.other[r] = static_cast<std::uint16_t>(other);
      sides.background[r] = static_cast<std::uint16_t>(tiles & ~other);
      any |= other;
    }
    sides.anyOther = any != 0;
    return sides;
  }

  /// The places of a row whose neighbours one step along an axis may be tiles on the background's side: what lies
  /// beyond the node may be anything.
  static unsigned maybeBesideBackground(const Rows& background, int row, int axis, int step) {
    if (axis == 2)
      return step < 0 ? unsigned{background[row]} << 1 | 1 : unsigned{background[row]} >> 1 | 1u << (kTiles - 1);
    const int at = axis == 0 ? row / kTiles : row % kTiles;
    const bool beyond = at + step < 0 || at + step >= kTiles;
    return beyond ? ~0u : unsigned{background[row + step * (axis == 0 ? kTiles : 1)]};
  }

  void findInParent(const Parent& node, Accessor& accessor, std::vector<Coord>& blocks) const {
    const TileSides sides = findSides(node);
    if (!sides.anyOther) return;
    const Coord origin = blockOf({node.origin().x(), node.origin().y(), node.origin().z()});
    for (int r = 0; r < kTiles * kTiles; ++r) {
      if (sides.other[r] == 0) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          unsigned faces = sides.other[r] & maybeBesideBackground(sides.background, r, axis, step);
          for (; faces != 0; faces &= faces - 1) {
            Coord b{origin[0] + r / kTiles, origin[1] + r % kTiles, origin[2] + std::countr_zero(faces)};
            b[axis] += step;
            visit(b, axis, step > 0, accessor, blocks);
          }
        }
    }
  }

  const TreeT& mTree;
  const Reader& mReader;
  bool mBackground;
};

}  // namespace pdc::detail
