#include "sample/mesh/mesh_solid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "mesh/winding/winding_number.h"
#include "parallel/block_progress.h"
#include "parallel/sort_unique.h"
#include "sample/block_index.h"

namespace pdc::detail {
namespace {

/// As long as caps add less, a point is inside where the closed surface's number is not 0.
constexpr double kLittle = 0.45;

Coord above(const Coord& point, Axis axis) {
  Coord next = point;
  ++next[axis];
  return next;
}

/// Whether points on the face of a block across an axis differ in side.
bool faceDiffers(const BlockSigns& signs, int axis, bool upper) {
  const int fixed = upper ? kBlockSize : 0;
  bool any = false, all = true;
  for (int i = 0; i < kBlockPoints; ++i)
    for (int j = 0; j < kBlockPoints; ++j) {
      const bool inside = axis == 0   ? signs.inside(fixed, i, j)
                          : axis == 1 ? signs.inside(i, fixed, j)
                                      : signs.inside(i, j, fixed);
      any = any || inside;
      all = all && inside;
    }
  return any != all;
}

std::vector<Coord> neighboursWithSurface(const std::vector<Coord>& blocks, const std::vector<BlockSigns>& signs) {
  std::vector<Coord> found;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (int face = 0; face < 6; ++face) {
      if (!faceDiffers(signs[i], face / 2, face % 2 != 0)) continue;
      Coord next = blocks[i];
      next[face / 2] += face % 2 != 0 ? 1 : -1;
      found.push_back(next);
    }
  return found;
}

/// Where f passes 0 between 0 and 1, to a thousandth: regula falsi, of which an end that stays counts half (Dowell &
/// Jarratt 1971).
template <typename F>
double rootOf(const F& f, double atFrom, double atTo) {
  constexpr double kExact = 1e-3;
  constexpr int kMostSteps = 12;
  double from = 0, to = 1, t = 0;
  int stayed = 0;
  for (int i = 0; i < kMostSteps && to - from > kExact; ++i) {
    const double last = t;
    t = std::clamp((from * atTo - to * atFrom) / (atTo - atFrom), from, to);
    if (i > 0 && std::abs(t - last) < kExact / 2) break;
    const double here = f(t);
    if ((here > 0) == (atFrom > 0)) {
      from = t, atFrom = here;
      if (stayed > 0) atTo /= 2;
      stayed = 1;
    } else {
      to = t, atTo = here;
      if (stayed < 0) atFrom /= 2;
      stayed = -1;
    }
  }
  return t;
}

}  // namespace

MeshSolid::MeshSolid(const ClosedSurface& surface, const MeshLattice& lattice, const Monitor& monitor)
    : mSurface(surface),
      mLattice(lattice),
      mCrossings{LatticeCrossings(surface, surface.own, lattice, kAxisX, monitor),
                 LatticeCrossings(surface, surface.own, lattice, kAxisY, monitor),
                 LatticeCrossings(surface, surface.surface.triangles.size(), lattice, kAxisZ, monitor)},
      mWinding(mCrossings[kAxisZ]),
      mCaps(surface, surface.caps()) {}

std::vector<Coord> MeshSolid::blocksWithTriangles() const {
  std::vector<Coord> blocks;
  for (const Axis axis : kAxes) {
    const Axis u = nextAxis(axis), v = previousAxis(axis);
    for (const EdgeCrossing& crossing : mCrossings[axis].all()) {
      const Coord point = mCrossings[axis].pointOf(crossing.edge), block = blockOf(point);
      // An edge on the border of blocks belongs to each of them.
      for (int i = 0; i <= (point[u] % kBlockSize == 0 ? 1 : 0); ++i)
        for (int j = 0; j <= (point[v] % kBlockSize == 0 ? 1 : 0); ++j) {
          Coord own = block;
          own[u] -= i;
          own[v] -= j;
          if (blocks.empty() || blocks.back() != own) blocks.push_back(own);
        }
    }
  }
  sortUnique(blocks);
  return blocks;
}

Box MeshSolid::boxOf(const Coord& low, int size) const {
  return {mLattice.at(low), mLattice.at(Coord{low[0] + size, low[1] + size, low[2] + size})};
}

void MeshSolid::readWhole(const Coord& block, BlockSigns& signs) const {
  std::array<std::int32_t, kBlockPoints> numbers{};
  for (int x = 0; x < kBlockPoints; ++x)
    for (int y = 0; y < kBlockPoints; ++y) {
      mWinding.read({kBlockSize * block[0] + x, kBlockSize * block[1] + y, kBlockSize * block[2]}, kBlockPoints,
                    numbers.data());
      unsigned row = 0;
      for (int z = 0; z < kBlockPoints; ++z) row |= unsigned{numbers[static_cast<std::size_t>(z)] != 0} << z;
      signs.row[static_cast<std::size_t>(kBlockPoints * x + y)] = static_cast<std::uint16_t>(row);
    }
}

void MeshSolid::subtractCaps(const Coord& block, BlockSigns& signs) const {
  constexpr int kPart = 3;  // Points along an axis; they share a bound.
  for (int x = 0; x < kBlockPoints; x += kPart)
    for (int y = 0; y < kBlockPoints; y += kPart)
      for (int z = 0; z < kBlockPoints; z += kPart) {
        const Coord low{kBlockSize * block[0] + x, kBlockSize * block[1] + y, kBlockSize * block[2] + z};
        if (mCaps.bound(boxOf(low, kPart - 1), kLittle) < kLittle) continue;
        for (int i = 0; i < kPart; ++i)
          for (int j = 0; j < kPart; ++j) {
            std::array<std::int32_t, kPart> numbers{};
            mWinding.read({low[0] + i, low[1] + j, low[2]}, kPart, numbers.data());
            unsigned row = signs.row[static_cast<std::size_t>(kBlockPoints * (x + i) + y + j)];
            for (int k = 0; k < kPart; ++k) {
              const double caps = mCaps.at(mLattice.at(Coord{low[0] + i, low[1] + j, low[2] + k}));
              const unsigned bit = 1U << (z + k);
              row = WindingNumber::isInside(numbers[static_cast<std::size_t>(k)] - caps) ? row | bit : row & ~bit;
            }
            signs.row[static_cast<std::size_t>(kBlockPoints * (x + i) + y + j)] = static_cast<std::uint16_t>(row);
          }
      }
}

bool MeshSolid::readSigns(const Coord& block, BlockSigns& signs) const {
  const Coord low{kBlockSize * block[0], kBlockSize * block[1], kBlockSize * block[2]};
  signs = {};
  readWhole(block, signs);
  if (!mCaps.empty() && !(mCaps.bound(boxOf(low, kBlockSize), kLittle) < kLittle)) subtractCaps(block, signs);
  return !signs.uniform();
}

SurfaceBlocks MeshSolid::surfaceBlocks(const Monitor& monitor) const {
  std::vector<Coord> todo = blocksWithTriangles(), known = todo;
  std::vector<std::pair<Coord, BlockSigns>> found;
  while (!todo.empty()) {
    std::vector<BlockSigns> signs(todo.size());
    std::vector<std::uint8_t> keep(todo.size());
    BlockProgress progress(monitor, "sample", todo.size());
    tbb::parallel_for(std::size_t{0}, todo.size(), [&](std::size_t i) {
      keep[i] = readSigns(todo[i], signs[i]);
      progress.advance(1);
    });
    std::vector<Coord> blocks;
    std::vector<BlockSigns> blockSigns;
    for (std::size_t i = 0; i < todo.size(); ++i) {
      if (keep[i] == 0) continue;
      blocks.push_back(todo[i]);
      blockSigns.push_back(signs[i]);
      found.emplace_back(todo[i], signs[i]);
    }
    // Where the mesh is closed all blocks with surface have triangles.
    std::vector<Coord> next = mCaps.empty() ? std::vector<Coord>() : neighboursWithSurface(blocks, blockSigns);
    sortUnique(next);
    todo.clear();
    std::set_difference(next.begin(), next.end(), known.begin(), known.end(), std::back_inserter(todo));
    known.insert(known.end(), todo.begin(), todo.end());
    std::sort(known.begin(), known.end());
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  SurfaceBlocks surface;
  for (const auto& [coord, signs] : found) {
    surface.coords.push_back(coord);
    surface.signs.push_back(signs);
  }
  return surface;
}

double MeshSolid::windingAt(const Coord& point) const { return mWinding.at(point) - mCaps.at(mLattice.at(point)); }

Vec3f MeshSolid::normalOf(std::uint32_t triangle) const {
  const std::array<Vec3d, 3> t = mSurface.points(triangle);
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  const double l = length(n);
  return l > 0 ? vecCast<float>(n * (1 / l)) : Vec3f{};
}

MeshSolid::Crossing MeshSolid::crossing(Axis axis, const Coord& point, bool insideAtLow) const {
  std::array<EdgeCrossing, 64> room;
  std::size_t count = 0;
  for (const EdgeCrossing& c : mCrossings[axis].along(point, 1))
    if (c.triangle < mSurface.own && count < room.size()) room[count++] = c;
  const EdgeCrossing* found = deciding({room.data(), count}, axis, point, insideAtLow);
  if (found == nullptr) return holeCrossing(axis, point);
  Vec3f normal = normalOf(found->triangle);
  if ((normal[axis] > 0) != insideAtLow) normal = -normal;
  return {static_cast<float>(found->t), normal};
}

const EdgeCrossing* MeshSolid::deciding(std::span<const EdgeCrossing> own, Axis axis, const Coord& point,
                                        bool insideAtLow) const {
  if (own.empty()) return nullptr;
  if (own.size() == 1) return &own.front();
  const double low = windingAt(point);
  double rest = windingAt(above(point, axis)) - low;
  for (const EdgeCrossing& c : own) rest += c.turn;
  // Where inside ends, seen from the end that is inside.
  const EdgeCrossing* found = nullptr;
  int turned = 0;
  for (const EdgeCrossing& c : own) {
    const double before = low - turned + c.t * rest, after = before - c.turn;
    turned += c.turn;
    if (WindingNumber::isInside(before) == WindingNumber::isInside(after) ||
        WindingNumber::isInside(before) != insideAtLow)
      continue;
    found = &c;
    if (insideAtLow) break;
  }
  return found;
}

MeshSolid::Crossing MeshSolid::holeCrossing(Axis axis, const Coord& point) const {
  // The winding number changes evenly here and that of the closed surface by whole numbers, so the caps' own tells the
  // fraction, and what is between the ends the rest.
  const double low = windingAt(point), high = windingAt(above(point, axis));
  const Vec3d p = mLattice.at(point);
  const auto place = [&](double t) {
    Vec3d q = p;
    q[axis] += t * mLattice.voxelSize;
    return q;
  };
  const auto winding = [&](double t) {
    const double fraction = -mCaps.at(place(t)), expected = low + (high - low) * t;
    return fraction + std::round(expected - fraction);
  };
  const double t =
      rootOf([&](double at) { return std::abs(winding(at)) - 0.5; }, std::abs(low) - 0.5, std::abs(high) - 0.5);
  const Vec3d outwards = mCaps.gradient(place(t)) * (winding(t) > 0 ? 1 : -1);
  const double l = length(outwards);
  return {static_cast<float>(t), l > 0 ? vecCast<float>(outwards * (1 / l)) : Vec3f{}};
}

}  // namespace pdc::detail
