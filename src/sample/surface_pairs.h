#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <array>
#include <memory>
#include <vector>

#include "parallel/isolated.h"
#include "pdc/sample/hermite_source.h"

namespace pdc::detail {

/// Where the surface crosses an edge of the lattice.
struct SurfacePoint {
  Vec3d position;  ///< World.
  Vec3d normal;    ///< Unit, outwards; zero where there is none.
};

/// Calls visit(a, b) for the two crossings of each square of the lattice that belongs to the block (by its low corner)
/// and has just two: neighbours along the surface, about a voxel apart.
template <typename Visit>
void forEachSurfaceSquare(const HermiteSource& source, const Coord& block, const BlockSigns& signs,
                          HermiteBlock& hermite, Visit&& visit) {
  const EdgeIndex edges(signs);
  source.fillHermite({block, signs, edges}, hermite);
  const auto changes = [&](Axis axis, const Coord& p) {
    Coord q = p;
    ++q[axis];
    return signs.inside(p[0], p[1], p[2]) != signs.inside(q[0], q[1], q[2]);
  };
  const auto crossing = [&](Axis axis, const Coord& p) -> SurfacePoint {
    const int i = edges(axis, p[0], p[1], p[2]);
    Vec3d x{double(kBlockSize * block[0] + p[0]), double(kBlockSize * block[1] + p[1]),
            double(kBlockSize * block[2] + p[2])};
    x[axis] += double(hermite.t[i]);
    return {source.map().position(x), vecCast<double>(Vec3f{hermite.nx[i], hermite.ny[i], hermite.nz[i]})};
  };
  for (int x = 0; x < kBlockSize; ++x)
    for (int y = 0; y < kBlockSize; ++y)
      for (int z = 0; z < kBlockSize; ++z)
        for (const Axis normal : kAxes) {
          const Axis u = nextAxis(normal), v = previousAxis(normal);
          const Coord low{x, y, z};
          Coord beyondU = low, beyondV = low;
          ++beyondU[u];
          ++beyondV[v];
          std::array<SurfacePoint, 2> found;
          int count = 0;
          const auto look = [&](Axis axis, const Coord& p) {
            if (changes(axis, p) && count++ < 2) found[count - 1] = crossing(axis, p);
          };
          look(u, low);
          look(v, low);
          look(u, beyondV);
          look(v, beyondU);
          if (count == 2) visit(found[0], found[1]);
        }
}

/// Maps the pairs of neighbouring crossings of a source to results, in parallel: visit(a, b, results) may append to
/// results. They come in the order of the blocks and squares.
template <typename Result, typename Visit>
std::vector<Result> mapSurfacePairs(const HermiteSource& source, const Monitor& monitor, const Visit& visit) {
  const SurfaceBlocks blocks = source.surfaceBlocks(monitor);
  std::vector<std::vector<Result>> found(blocks.coords.size());
  tbb::enumerable_thread_specific<std::unique_ptr<HermiteBlock>> scratch(
      [] { return std::make_unique<HermiteBlock>(); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, found.size()), [&](const auto& range) {
    isolated([&] {
      HermiteBlock& hermite = *scratch.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        monitor.throwIfStopped();
        forEachSurfaceSquare(source, blocks.coords[i], blocks.signs[i], hermite,
                             [&](const SurfacePoint& a, const SurfacePoint& b) { visit(a, b, found[i]); });
      }
    });
  });
  std::vector<Result> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace pdc::detail
