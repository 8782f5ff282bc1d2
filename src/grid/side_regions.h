#pragma once

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace pdc::detail {

/// On which side of an isovalue the values of a leaf are: a bit for each voxel, a word for each x, that are set inside.
struct LeafSides {
  openvdb::Coord origin;
  std::array<std::uint64_t, 8> inside{};
};

/// A tile of `dim` voxels along each axis.
struct TileSide {
  openvdb::Coord origin;
  std::int32_t dim = 0;
  bool inside = false;
};

/// The sides of a tree's values, leaves in the order of the tree, then all tiles. The background is outside.
struct TreeSides {
  std::vector<LeafSides> leaves;
  std::vector<TileSide> tiles;
};

/// The connected parts of one side of a tree, along the axes: the largest is number 0; those of a size are in the order
/// of the tree. The outside's part that all of space beyond the tree belongs to is kBeyond.
class SideRegions {
 public:
  static constexpr std::uint32_t kBeyond = std::numeric_limits<std::uint32_t>::max();

  SideRegions(const TreeSides& sides, bool inside);

  /// Voxels of each part, kBeyond left out.
  [[nodiscard]] const std::vector<std::uint64_t>& sizes() const { return mSizes; }
  /// The part of a voxel, which is on this side.
  [[nodiscard]] std::uint32_t ofVoxel(std::size_t leaf, std::uint32_t voxel) const {
    return mNumber[mFirst[leaf] + mLabels[leaf][voxel]];
  }
  /// The part of a tile, which is on this side.
  [[nodiscard]] std::uint32_t ofTile(std::size_t tile) const { return mNumber[mFirst[mLabels.size() + tile]]; }

 private:
  using Labels = std::array<std::uint16_t, 512>;

  void labelLeaves(const TreeSides& sides);
  void connect(const TreeSides& sides);
  void connectFace(std::uint32_t leaf, int face, std::uint32_t element, const TreeSides& sides);
  void connectLeaves(std::uint32_t a, std::uint32_t b, int axis, const TreeSides& sides);
  void number(const TreeSides& sides);
  std::uint32_t find(std::uint32_t element);
  void join(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint64_t bitsOf(const LeafSides& leaf, int x) const {
    return mInside ? leaf.inside[static_cast<std::size_t>(x)] : ~leaf.inside[static_cast<std::size_t>(x)];
  }

  bool mInside;
  std::vector<Labels> mLabels;          ///< Parts within each leaf.
  std::vector<std::uint32_t> mFirst;    ///< The first element of each leaf, then of each tile; 0 is what lies beyond.
  std::vector<std::uint32_t> mParents;  ///< Elements that are connected.
  std::vector<std::uint32_t> mNumber;   ///< The part of each element.
  std::vector<std::uint64_t> mSizes;
};

}  // namespace pdc::detail
