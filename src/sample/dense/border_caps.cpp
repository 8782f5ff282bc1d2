#include "sample/dense/border_caps.h"

#include <algorithm>
#include <cmath>

#include "pdc/math/mat3.h"
#include "sample/block_origin.h"
#include "sample/cell_edges.h"
#include "sample/stencils/block_hermite.h"

namespace pdc::detail {
namespace {

/// Caps are exact: with more, vertices are drawn from them by as much as they are drawn to the crossings' mean.
constexpr float kSigmaNormal = 0.004F;
/// Normals within 30° of their mean belong to one plane.
constexpr double kOnePlane = 0.866;

/// The crossings of a patch.
struct PatchCrossing {
  Vec3f point;   ///< From the block's origin.
  Vec3d normal;  ///< World.
  Axis axis;
};
struct PatchCrossings {
  std::array<PatchCrossing, kEdges> crossing;
  int count = 0;

  [[nodiscard]] std::span<const PatchCrossing> all() const {
    return {crossing.data(), static_cast<std::size_t>(count)};
  }
};

Vec3d normalOf(const HermiteBlock& hermite, int edge) { return {hermite.nx[edge], hermite.ny[edge], hermite.nz[edge]}; }

/// Adds planes of those crossings that lie on no cap: one if they agree.
void addOthers(const PatchCrossings& others, const Mat3d& toRow, FeaturePlanes& planes) {
  Vec3d normal{};
  Vec3f point{};
  for (const PatchCrossing& c : others.all()) {
    normal += c.normal;
    point += c.point * (1.0F / static_cast<float>(others.count));
  }
  const double l = length(normal);
  if (!(l > 0)) return;
  normal *= 1 / l;
  const bool one = std::ranges::all_of(others.all(), [&](const PatchCrossing& c) {
    return dot(c.normal, normal) > kOnePlane || dot(c.normal, c.normal) == 0;
  });
  if (one) {
    planes.planes.push_back({point, vecCast<float>(toRow * normal)});
    return;
  }
  for (const PatchCrossing& c : others.all())
    if (dot(c.normal, c.normal) > 0) planes.planes.push_back({c.point, vecCast<float>(toRow * c.normal)});
}

}  // namespace

bool BorderCaps::hasData(const Coord& p) const {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < 0 || p[axis] >= mSize[axis]) return false;
  return mMask == nullptr || mMask->inside(p);
}

bool BorderCaps::mayTouch(const Coord& block) const {
  for (int axis = 0; axis < 3; ++axis)
    if (block[axis] < 0 || std::int64_t{kBlockSize} * (block[axis] + 1) >= mSize[axis]) return true;
  if (mMask == nullptr) return false;
  for (int i = 0; i < kBlockParts; ++i)
    if (mMask->side({block[0] + (i >> 2), block[1] + (i >> 1 & 1), block[2] + (i & 1)}) != Side::kInside) return true;
  return false;
}

/// Calls visit(edge, axis, whether its low end is inside) for the crossings that have no data at their outer end.
template <typename Visit>
void BorderCaps::forEachCap(const SurfaceBlock& block, const Visit& visit) const {
  block.edges.forEach([&](int i, Axis axis, int x, int y, int z) {
    const bool lowInside = block.signs.inside(x, y, z);
    Coord outer{kBlockSize * block.coord[0] + x, kBlockSize * block.coord[1] + y, kBlockSize * block.coord[2] + z};
    if (lowInside) ++outer[axis];
    if (!hasData(outer)) visit(i, axis, lowInside);
  });
}

void BorderCaps::place(const SurfaceBlock& block, HermiteBlock& hermite) const {
  const Vec3d origin = blockOrigin(block.coord);
  const Mat3d affine = normalMapAt(mMap, origin);
  forEachCap(block, [&](int i, Axis axis, bool lowInside) {
    const std::uint16_t p = block.edges.points()[i];
    const Mat3d map =
        mMap.affine() ? affine : normalMapAt(mMap, origin + Vec3d{double(p >> 8), double(p >> 4 & 15), double(p & 15)});
    Vec3d step{};
    step[axis] = lowInside ? 1 : -1;
    const Vec3d n = map * step;
    const Vec3f normal = vecCast<float>(n * (1 / length(n)));
    hermite.t[i] = 0.5F;
    hermite.nx[i] = normal.x;
    hermite.ny[i] = normal.y;
    hermite.nz[i] = normal.z;
  });
}

void BorderCaps::clearNoise(const SurfaceBlock& block, bool weighted, PlaneNoise& noise) const {
  forEachCap(block, [&](int i, Axis, bool) {
    noise.sigma[i] = 0;
    if (weighted) noise.weight[i] *= 2;  // The outer end, half-way to which it lies, counted as 0.
  });
}

void BorderCaps::addPlanes(const SurfaceBlock& block, const HermiteBlock& hermite,
                           std::span<const SurfacePatch> patches, FeaturePlanes& planes) const {
  std::array<bool, EdgeIndex::kMaxEdges> cap{};
  forEachCap(block, [&](int i, Axis, bool) { cap[i] = true; });
  const Mat3d toRow = (mMap.jacobian(blockOrigin(block.coord)) * (1 / mMap.voxelSize())).transposed();
  const std::size_t before = planes.patches.size();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    PatchCrossings others;
    std::array<const PatchCrossing*, 3> capAlong{};
    PatchCrossings caps;
    forEachEdge(patches[i], block.edges, [&](int e, int edge) {
      Vec3d at = cornerPlace(kCellEdge[e].low);
      for (int k = 0; k < 3; ++k) at[k] += patches[i].cell.low()[k];
      const Axis axis = kCellEdge[e].axis;
      at[axis] += double(hermite.t[edge]);
      PatchCrossings& list = cap[edge] ? caps : others;
      list.crossing[list.count++] = {vecCast<float>(at), normalOf(hermite, edge), axis};
      if (cap[edge]) capAlong[axis] = &list.crossing[list.count - 1];
    });
    const auto axes = std::ranges::count_if(capAlong, [](const PatchCrossing* c) { return c != nullptr; });
    if (axes == 0 || (axes == 1 && others.count == 0)) continue;
    const auto first = static_cast<std::uint32_t>(planes.planes.size());
    for (const PatchCrossing* c : capAlong)
      if (c != nullptr) planes.planes.push_back({c->point, vecCast<float>(toRow * c->normal)});
    addOthers(others, toRow, planes);
    const auto count = static_cast<std::uint32_t>(planes.planes.size()) - first;
    planes.patches.push_back({static_cast<std::uint32_t>(i), first, count, kSigmaNormal});
  }
  // What distances told of these patches knows nothing of the caps.
  const auto added = planes.patches.begin() + static_cast<std::ptrdiff_t>(before);
  const auto isReplaced = [&](const FeaturePlanes::Patch& p) {
    return std::any_of(added, planes.patches.end(),
                       [&](const FeaturePlanes::Patch& own) { return own.patch == p.patch; });
  };
  planes.patches.erase(std::remove_if(planes.patches.begin(), added, isReplaced), added);
  std::ranges::sort(planes.patches, {}, &FeaturePlanes::Patch::patch);
}

}  // namespace pdc::detail
