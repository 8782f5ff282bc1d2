#pragma once

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "pdc/monitor.h"
#include "pdc/sample/hermite_block.h"
#include "sample/block_index.h"
#include "sample/grid_sampler.h"

namespace pdc::detail {

/// From stored value to the function that is negative inside.
template <typename ValueT>
struct ValueReader {
  GridReading reading;

  [[nodiscard]] bool inside(ValueT v) const {
    const auto d = static_cast<double>(v);
    return reading.insideIsHigher ? d > reading.iso : d < reading.iso;
  }
  [[nodiscard]] float value(ValueT v) const {
    const double d = static_cast<double>(v) - reading.iso;
    return static_cast<float>(reading.insideIsHigher ? -d : d);
  }
  /// False for values that must not enter a slope: clamped or not finite.
  static bool finite(ValueT v) {
    if constexpr (std::is_floating_point_v<ValueT>) return std::isfinite(v);
    return true;
  }
};

/// A leaf's 512 values by offset, read from its buffer directly where there is one of that type.
template <typename LeafT>
class LeafValues {
 public:
  using ValueT = typename LeafT::ValueType;
  static constexpr bool kBits = std::is_same_v<ValueT, bool>;

  /// \param leaf may be null; there are no values to read then.
  explicit LeafValues(const LeafT* leaf) : mLeaf(leaf) {
    if constexpr (!kBits) mData = leaf == nullptr ? nullptr : leaf->buffer().data();
  }
  ValueT operator[](openvdb::Index offset) const {
    if constexpr (kBits) {
      return mLeaf->getValue(offset);
    } else {
      return mData[offset];
    }
  }

 private:
  const LeafT* mLeaf;
  const ValueT* mData = nullptr;
};

/// Blocks beyond this index would overflow 32-bit lattice coordinates once a neighbour is added.
inline constexpr openvdb::Int32 kMaxIndex = 1 << 30;

/// \throws Error if a lattice point lies too far out.
inline void checkIndex(const openvdb::Coord& c) {
  for (int i = 0; i < 3; ++i)
    if (c[i] > kMaxIndex || c[i] < -kMaxIndex)
      throw Error(fmt::format("the grid reaches index {}, the limit is {}", c[i], kMaxIndex));
}

/// The leaves of a tree as blocks: which of their points are inside, which are active, found by block coordinate.
template <typename TreeT>
class GridLeaves {
 public:
  using LeafT = typename TreeT::LeafNodeType;
  using ValueT = typename TreeT::ValueType;
  static_assert(LeafT::DIM == kBlockSize, "blocks are leaves");

  /// Reads all leaves in parallel. \throws Error for non-finite values that were not accepted.
  GridLeaves(const TreeT& tree, const ValueReader<ValueT>& reader) : mReader(reader) {
    tree.getNodes(mLeaves);
    mCoords.resize(mLeaves.size());
    mInside.resize(mLeaves.size());
    for (const LeafT* leaf : mLeaves) checkIndex(leaf->origin());
    std::vector<std::size_t> nonFinite(mLeaves.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mLeaves.size(), 64), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const openvdb::Coord o = mLeaves[i]->origin();
        mCoords[i] = blockOf({o.x(), o.y(), o.z()});
        nonFinite[i] = readLeaf(*mLeaves[i], mInside[i]);
      }
    });
    if (!reader.reading.acceptNonFinite) rejectNonFinite(nonFinite);
    mIndex = BlockIndex(mCoords);
  }

  [[nodiscard]] std::size_t size() const { return mLeaves.size(); }
  [[nodiscard]] const std::vector<Coord>& coords() const { return mCoords; }
  [[nodiscard]] std::int32_t find(const Coord& block) const { return mIndex.find(block); }
  [[nodiscard]] const CellMask& inside(std::size_t i) const { return mInside[i]; }
  [[nodiscard]] const LeafT& leaf(std::size_t i) const { return *mLeaves[i]; }
  /// The leaf's active points, bits as in CellMask.
  [[nodiscard]] CellMask active(std::size_t i) const {
    CellMask m;
    const auto& mask = mLeaves[i]->getValueMask();
    for (openvdb::Index w = 0; w < 8; ++w) m.word[w] = mask.template getWord<std::uint64_t>(w);
    return m;
  }

 private:
  /// \returns the number of values that are not finite.
  std::size_t readLeaf(const LeafT& leaf, CellMask& inside) const {
    std::size_t bad = 0;
    const LeafValues<LeafT> values(&leaf);
    for (openvdb::Index x = 0; x < 8; ++x) {
      std::uint64_t word = 0;
      for (openvdb::Index i = 0; i < 64; ++i) {
        const ValueT v = values[64 * x + i];
        word |= std::uint64_t{mReader.inside(v)} << i;
        bad += !ValueReader<ValueT>::finite(v);
      }
      inside.word[x] = word;
    }
    return bad;
  }

  void rejectNonFinite(const std::vector<std::size_t>& counts) const {
    std::size_t total = 0;
    const LeafT* first = nullptr;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      total += counts[i];
      if (counts[i] != 0 && first == nullptr) first = mLeaves[i];
    }
    if (first == nullptr) return;
    openvdb::Index offset = 0;
    while (ValueReader<ValueT>::finite(first->getValue(offset))) ++offset;
    const openvdb::Coord at = first->offsetToGlobalCoord(offset);
    throw Error(fmt::format(
        "{} voxels are not finite, the first at ({}, {}, {}) is {}; accept them as outside if that is meant", total,
        at.x(), at.y(), at.z(), static_cast<double>(first->getValue(offset))));
  }

  ValueReader<ValueT> mReader;
  std::vector<const LeafT*> mLeaves;
  std::vector<Coord> mCoords;
  std::vector<CellMask> mInside;
  BlockIndex mIndex;
};

/// Tiles that lie on the other side of the isovalue than the background, beside blocks that do not: where a surface can
/// pass without touching any leaf. Appends the blocks whose cells may hold it; may append a block more than once.
template <typename TreeT>
void findTileFaces(const TreeT& tree, const ValueReader<typename TreeT::ValueType>& reader, const Monitor& monitor,
                   std::vector<Coord>& blocks) {
  const bool background = reader.inside(tree.background());
  openvdb::tree::ValueAccessor<const TreeT> accessor(tree);
  /// Cells about the lattice edges that leave block b along `axis`.
  const auto addCellsAt = [&](const Coord& b, int axis) {
    for (int i = 0; i < 4; ++i) {
      Coord c = b;
      c[(axis + 1) % 3] -= i & 1;
      c[(axis + 2) % 3] -= i >> 1;
      blocks.push_back(c);
    }
  };
  /// One side of a tile: the layer of blocks beyond it along `axis`.
  const auto visitSide = [&](const openvdb::CoordBBox& box, int axis, bool high) {
    openvdb::CoordBBox layer = box;
    layer.min()[axis] = layer.max()[axis] = high ? box.max()[axis] + 1 : box.min()[axis] - kBlockSize;
    for (openvdb::Int32 x = layer.min().x(); x <= layer.max().x(); x += kBlockSize)
      for (openvdb::Int32 y = layer.min().y(); y <= layer.max().y(); y += kBlockSize)
        for (openvdb::Int32 z = layer.min().z(); z <= layer.max().z(); z += kBlockSize) {
          const openvdb::Coord p(x, y, z);
          // Cells beside a leaf are found from the leaf.
          if (accessor.probeConstLeaf(p) != nullptr || reader.inside(accessor.getValue(p)) != background) continue;
          Coord b = blockOf({x, y, z});
          b[axis] -= high;
          addCellsAt(b, axis);
        }
  };
  auto it = tree.cbeginValueAll();
  it.setMaxDepth(TreeT::ValueAllCIter::LEAF_DEPTH - 1);
  for (; it; ++it) {
    if (reader.inside(*it) == background) continue;
    monitor.throwIfStopped();
    openvdb::CoordBBox box;
    it.getBoundingBox(box);
    checkIndex(box.min());
    checkIndex(box.max());
    for (int axis = 0; axis < 3; ++axis) {
      visitSide(box, axis, false);
      visitSide(box, axis, true);
    }
  }
}

}  // namespace pdc::detail
