#include "grid/trim_band.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <cmath>

#include "grid/real_grid.h"

namespace pdc::detail {
namespace {

/// The active voxels of one sign.
template <typename TreeT>
openvdb::MaskTree voxelsOfSign(const TreeT& tree, bool negative) {
  openvdb::MaskTree mask(tree, false, openvdb::TopologyCopy());
  openvdb::tree::LeafManager<openvdb::MaskTree> leaves(mask);
  leaves.foreach ([&](auto& leaf, std::size_t) {
    const auto* values = tree.probeConstLeaf(leaf.origin());
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel)
      if ((values->getValue(voxel.pos()) < 0) != negative) leaf.setValueOff(voxel.pos());
  });
  return mask;
}

/// Grows a mask by about one voxel to all sides: steps to six and to 26 neighbours in turn are near to balls.
void grow(openvdb::MaskTree& mask, int step) {
  openvdb::tools::dilateActiveValues(mask, 1,
                                     step % 2 == 1 ? openvdb::tools::NN_FACE : openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::PRESERVE_TILES);
}

/// A mask in the place of one leaf; growing makes tiles of leaves that are full.
class LeafMask {
 public:
  LeafMask(const openvdb::MaskTree& mask, const openvdb::Coord& origin)
      : mLeaf(mask.probeConstLeaf(origin)), mTile(mLeaf == nullptr && mask.isValueOn(origin)) {}
  [[nodiscard]] bool isOn(openvdb::Index voxel) const { return mLeaf != nullptr ? mLeaf->isValueOn(voxel) : mTile; }

 private:
  const openvdb::MaskTree::LeafNodeType* mLeaf;
  bool mTile;
};

template <typename GridT>
void trim(GridT& grid) {
  using Value = typename GridT::ValueType;
  const Value background = grid.background();
  const double voxel = grid.voxelSize()[0];
  openvdb::MaskTree nearInside = voxelsOfSign(grid.tree(), true), nearOutside = voxelsOfSign(grid.tree(), false);
  openvdb::tree::LeafManager<typename GridT::TreeType> leaves(grid.tree());
  const int most = static_cast<int>(std::ceil(background / voxel)) + 1;
  for (int step = 1; step <= most; ++step) {
    grow(nearInside, step);
    grow(nearOutside, step);
    leaves.foreach ([&](auto& leaf, std::size_t) {
      const LeafMask inside(nearInside, leaf.origin()), outside(nearOutside, leaf.origin());
      for (auto value = leaf.beginValueOn(); value; ++value) {
        // A voxel that is k voxels from the surface has one of the other sign in reach of k + 1 steps.
        const int reach = static_cast<int>(std::ceil(std::abs(*value) / voxel)) + 1;
        if (std::clamp(reach, 1, most) != step) continue;
        const bool negative = *value < 0;
        if (!(negative ? outside : inside).isOn(value.pos()))
          leaf.setValueOff(value.pos(), negative ? -background : background);
      }
    });
  }
  openvdb::tools::pruneLevelSet(grid.tree());
}

}  // namespace

void trimBand(GridVolume& volume) {
  if (volume.gridClass != GridClass::kLevelSet || !volume.distances) return;
  visitReal(volume, "trimBand", [](auto& grid) { trim(grid); });
}

}  // namespace pdc::detail
