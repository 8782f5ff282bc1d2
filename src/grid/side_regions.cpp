#include "grid/side_regions.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

#include "parallel/for_each_in_parallel.h"

namespace pdc::detail {
namespace {

constexpr std::int32_t kSide = 8;
/// What the tree of numbers has where there is neither leaf nor tile.
constexpr std::int32_t kNone = -1;

using Bits = std::array<std::uint64_t, 8>;

/// What is connected to `seed` within the bits of `side`. A word is a plane of constant x, a byte a row of constant y.
Bits floodFrom(const Bits& seed, const Bits& side) {
  // What is shifted along z must not come out in the next row.
  constexpr std::uint64_t kNotFirst = 0xFEFEFEFEFEFEFEFE, kNotLast = 0x7F7F7F7F7F7F7F7F;
  Bits filled = seed;
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t x = 0; x < filled.size(); ++x) {
      const std::uint64_t f = filled[x];
      std::uint64_t next = f | (f << 1 & kNotFirst) | (f >> 1 & kNotLast) | f << 8 | f >> 8;
      if (x > 0) next |= filled[x - 1];
      if (x + 1 < filled.size()) next |= filled[x + 1];
      next &= side[x];
      grew = grew || next != f;
      filled[x] = next;
    }
  }
  return filled;
}

/// The offset of a voxel on a leaf's face across an axis; u and v run along the other two.
std::uint32_t faceVoxel(int axis, int layer, int u, int v) {
  const int at[3][3] = {{layer, u, v}, {u, layer, v}, {u, v, layer}};
  return static_cast<std::uint32_t>(at[axis][0] * kSide * kSide + at[axis][1] * kSide + at[axis][2]);
}

bool isOn(const LeafSides& leaf, std::uint32_t voxel) { return (leaf.inside[voxel / 64] >> voxel % 64 & 1) != 0; }

}  // namespace

SideRegions::SideRegions(const TreeSides& sides, bool inside) : mInside(inside), mLabels(sides.leaves.size()) {
  labelLeaves(sides);
  connect(sides);
  number(sides);
}

void SideRegions::labelLeaves(const TreeSides& sides) {
  std::vector<std::uint32_t> counts(sides.leaves.size());
  forEachInParallel(sides.leaves.size(), 16, [&](std::uint32_t l) {
    Bits left;
    for (int x = 0; x < kSide; ++x) left[static_cast<std::size_t>(x)] = bitsOf(sides.leaves[l], x);
    for (std::size_t x = 0; x < left.size();) {
      if (left[x] == 0) {
        ++x;
        continue;
      }
      Bits seed{};
      seed[x] = left[x] & (~left[x] + 1);
      const Bits part = floodFrom(seed, left);
      for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] &= ~part[i];
        for (std::uint64_t bits = part[i]; bits != 0; bits &= bits - 1)
          mLabels[l][64 * i + static_cast<std::size_t>(std::countr_zero(bits))] = static_cast<std::uint16_t>(counts[l]);
      }
      ++counts[l];
    }
  });
  std::uint32_t next = 1;
  for (const std::uint32_t count : counts) {
    mFirst.push_back(next);
    next += count;
  }
  for (std::size_t t = 0; t < sides.tiles.size(); ++t) mFirst.push_back(next++);
  mParents.resize(next);
  std::iota(mParents.begin(), mParents.end(), 0);
}

std::uint32_t SideRegions::find(std::uint32_t element) {
  while (mParents[element] != element) {
    mParents[element] = mParents[mParents[element]];
    element = mParents[element];
  }
  return element;
}

void SideRegions::join(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  mParents[std::max(a, b)] = std::min(a, b);
}

/// \param face twice the axis, and one more for the upper face. \param element what lies beside all of it.
void SideRegions::connectFace(std::uint32_t leaf, int face, std::uint32_t element, const TreeSides& sides) {
  for (int u = 0; u < kSide; ++u)
    for (int v = 0; v < kSide; ++v) {
      const std::uint32_t voxel = faceVoxel(face / 2, face % 2 == 1 ? kSide - 1 : 0, u, v);
      if (isOn(sides.leaves[leaf], voxel) == mInside) join(mFirst[leaf] + mLabels[leaf][voxel], element);
    }
}

namespace {

/// The number of the leaf, or of the tile plus that of leaves, at each coordinate.
openvdb::Int32Tree numberTree(const TreeSides& sides) {
  openvdb::Int32Tree numbers(kNone);
  std::int32_t next = 0;
  for (const LeafSides& leaf : sides.leaves) numbers.addTile(1, leaf.origin, next++, true);
  for (const TileSide& tile : sides.tiles)
    numbers.addTile(tile.dim == kSide ? 1 : tile.dim == 16 * kSide ? 2 : 3, tile.origin, next++, true);
  return numbers;
}

}  // namespace

void SideRegions::connect(const TreeSides& sides) {
  const auto leaves = static_cast<std::int32_t>(sides.leaves.size());
  const openvdb::Int32Tree numbers = numberTree(sides);
  const openvdb::tree::ValueAccessor<const openvdb::Int32Tree> number(numbers);
  const auto beside = [&](const openvdb::Coord& origin, std::int32_t dim, int face) {
    openvdb::Coord at = origin;
    at[face / 2] += face % 2 == 1 ? dim : -1;
    return number.getValue(at);
  };
  // The element of a tile or of what lies beyond, if it is on this side.
  const auto elementOf = [&](std::int32_t n) -> std::optional<std::uint32_t> {
    if (n == kNone) return mInside ? std::nullopt : std::optional<std::uint32_t>(0);
    if (sides.tiles[static_cast<std::size_t>(n - leaves)].inside != mInside) return std::nullopt;
    return mFirst[static_cast<std::size_t>(n)];
  };
  for (std::uint32_t l = 0; l < sides.leaves.size(); ++l)
    for (int face = 0; face < 6; ++face) {
      const std::int32_t n = beside(sides.leaves[l].origin, kSide, face);
      const bool up = face % 2 == 1, isLeaf = n != kNone && n < leaves;
      if (isLeaf && up) connectLeaves(l, static_cast<std::uint32_t>(n), face / 2, sides);
      if (isLeaf) continue;
      if (const auto element = elementOf(n)) connectFace(l, face, *element, sides);
    }
  // A tile asks for what is as large as it or larger: what is smaller asks for the tile.
  for (std::size_t t = 0; t < sides.tiles.size(); ++t) {
    const TileSide& tile = sides.tiles[t];
    for (int face = 0; tile.inside == mInside && face < 6; ++face) {
      const std::int32_t n = beside(tile.origin, tile.dim, face);
      if (n != kNone && n < leaves) continue;
      if (const auto element = elementOf(n)) join(mFirst[sides.leaves.size() + t], *element);
    }
  }
}

void SideRegions::connectLeaves(std::uint32_t a, std::uint32_t b, int axis, const TreeSides& sides) {
  for (int u = 0; u < kSide; ++u)
    for (int v = 0; v < kSide; ++v) {
      const std::uint32_t last = faceVoxel(axis, kSide - 1, u, v), first = faceVoxel(axis, 0, u, v);
      if (isOn(sides.leaves[a], last) == mInside && isOn(sides.leaves[b], first) == mInside)
        join(mFirst[a] + mLabels[a][last], mFirst[b] + mLabels[b][first]);
    }
}

void SideRegions::number(const TreeSides& sides) {
  std::vector<std::uint64_t> voxels(mParents.size());
  for (std::size_t l = 0; l < sides.leaves.size(); ++l)
    for (std::uint32_t v = 0; v < mLabels[l].size(); ++v)
      if (isOn(sides.leaves[l], v) == mInside) ++voxels[find(mFirst[l] + mLabels[l][v])];
  for (std::size_t t = 0; t < sides.tiles.size(); ++t) {
    const auto dim = static_cast<std::uint64_t>(sides.tiles[t].dim);
    if (sides.tiles[t].inside == mInside) voxels[find(mFirst[sides.leaves.size() + t])] += dim * dim * dim;
  }
  // Roots are the least elements of their parts, so their order is that of the tree.
  std::vector<std::uint32_t> roots;
  for (std::uint32_t e = 1; e < mParents.size(); ++e)
    if (mParents[e] == e && voxels[e] > 0) roots.push_back(e);
  std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return voxels[a] > voxels[b]; });
  std::vector<std::uint32_t> ofRoot(mParents.size(), kBeyond);
  for (std::uint32_t i = 0; i < roots.size(); ++i) {
    ofRoot[roots[i]] = i;
    mSizes.push_back(voxels[roots[i]]);
  }
  mNumber.resize(mParents.size());
  for (std::uint32_t e = 0; e < mParents.size(); ++e) mNumber[e] = ofRoot[find(e)];
}

}  // namespace pdc::detail
