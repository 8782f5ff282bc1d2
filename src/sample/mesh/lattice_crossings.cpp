#include "sample/mesh/lattice_crossings.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "mesh/winding/lattice_line.h"

namespace pdc::detail {
namespace {

constexpr int kBits = 21;  // Of a coordinate; MeshSource refuses larger lattices.
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

using Points = std::array<Vec3d, 3>;

/// A triangle and the lines along an axis that may pass through it.
class LineScan {
 public:
  LineScan(const Points& triangle, const MeshLattice& lattice, Axis axis)
      : mTriangle(triangle), mLattice(lattice), mAxis(axis) {
    for (std::size_t k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a) mPlace[k][a] = (triangle[k][a] - lattice.origin[a]) / lattice.voxelSize;
    mNormal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  }

  /// Calls visit(point, t, turn) for each edge that passes through: its lower end, where, and the normal's sign.
  template <typename Visit>
  void forEachEdge(Visit&& visit) const {
    const Axis u = nextAxis(mAxis), v = previousAxis(mAxis);
    const auto [low, high] = range(u);
    for (int row = static_cast<int>(std::ceil(low - kSlack)); row <= high + kSlack; ++row) {
      const auto [from, to] = section(u, v, row);
      for (int column = static_cast<int>(std::ceil(from - kSlack)); column <= to + kSlack; ++column) {
        Coord point{};
        point[u] = row;
        point[v] = column;
        if (const int turn = passThrough(mLattice.at(point), mAxis, mTriangle); turn != 0) {
          const double t = findEdge(point, turn);
          visit(point, t, turn);
        }
      }
    }
  }

 private:
  /// Rounding cannot move a triangle by as much, in voxels.
  static constexpr double kSlack = 1e-3;

  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void include(double x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  };

  [[nodiscard]] Range range(int axis) const {
    Range r;
    for (const Vec3d& p : mPlace) r.include(p[axis]);
    return r;
  }

  /// What of the triangle lies within a hair of a row, along v.
  [[nodiscard]] Range section(int u, int v, double row) const {
    Range r;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& a = mPlace[k];
      const Vec3d& b = mPlace[(k + 1) % 3];
      const double low = std::min(a[u], b[u]), high = std::max(a[u], b[u]);
      if (high < row - kSlack || low > row + kSlack) continue;
      for (const double side : {row - kSlack, row + kSlack}) {
        const double t = high > low ? std::clamp((side - a[u]) / (b[u] - a[u]), 0.0, 1.0) : 0;
        r.include(a[v] + (b[v] - a[v]) * t);
      }
      if (!(high > low)) r.include(b[v]);
    }
    return r;
  }

  /// Sets the point's coordinate along the line so that its edge passes through. \returns where, from 0 to 1.
  [[nodiscard]] double findEdge(Coord& point, int turn) const {
    const Axis u = nextAxis(mAxis), v = previousAxis(mAxis);
    const Vec3d p = mLattice.at(point);
    const Vec3d& a = mTriangle[0];
    const double along = a[mAxis] - (mNormal[u] * (p[u] - a[u]) + mNormal[v] * (p[v] - a[v])) / mNormal[mAxis];
    const Range limits = range(mAxis);
    const double place = std::clamp((along - mLattice.origin[mAxis]) / mLattice.voxelSize, limits.low, limits.high);
    int& k = point[mAxis];
    k = static_cast<int>(std::floor(place));
    const auto isBelow = [&] { return sideOfPlane(mLattice.at(point), mTriangle) != turn; };
    while (!isBelow()) --k;
    for (++k; isBelow();) ++k;
    --k;
    return std::clamp(place - k, 0.0, 1.0);
  }

  const Points& mTriangle;
  const MeshLattice& mLattice;
  Axis mAxis;
  Points mPlace{};  ///< In lattice units.
  Vec3d mNormal;
};

}  // namespace

std::uint64_t LatticeCrossings::edgeKey(const Coord& point) const {
  const auto part = [&](Axis axis) { return static_cast<std::uint64_t>(point[axis]); };
  return (part(nextAxis(mAxis)) << kBits | part(previousAxis(mAxis))) << kBits | part(mAxis);
}

Coord LatticeCrossings::pointOf(std::uint64_t edge) const {
  Coord point{};
  point[mAxis] = static_cast<std::int32_t>(edge & kMask);
  point[previousAxis(mAxis)] = static_cast<std::int32_t>(edge >> kBits & kMask);
  point[nextAxis(mAxis)] = static_cast<std::int32_t>(edge >> (2 * kBits));
  return point;
}

LatticeCrossings::LatticeCrossings(const ClosedSurface& surface, std::size_t triangles, const MeshLattice& lattice,
                                   Axis axis, const Monitor& monitor)
    : mAxis(axis) {
  constexpr std::size_t kChunk = 256;
  std::vector<std::vector<EdgeCrossing>> parts((triangles + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    monitor.throwIfStopped();
    for (std::size_t i = part * kChunk; i < std::min(triangles, (part + 1) * kChunk); ++i) {
      const Points points = surface.points(i);
      LineScan(points, lattice, axis).forEachEdge([&](const Coord& point, double t, int turn) {
        parts[part].push_back({edgeKey(point), t, static_cast<std::uint32_t>(i), turn});
      });
    }
  });
  for (const auto& part : parts) mCrossings.insert(mCrossings.end(), part.begin(), part.end());
  monitor.throwIfStopped();
  tbb::parallel_sort(mCrossings.begin(), mCrossings.end(), [](const EdgeCrossing& a, const EdgeCrossing& b) {
    return std::tie(a.edge, a.t, a.triangle) < std::tie(b.edge, b.t, b.triangle);
  });
}

std::span<const EdgeCrossing> LatticeCrossings::along(const Coord& point, int count) const {
  const Axis u = nextAxis(mAxis), v = previousAxis(mAxis);
  const auto within = [](std::int32_t c) { return c >= 0 && static_cast<std::uint64_t>(c) <= kMask; };
  if (!within(point[u]) || !within(point[v])) return {};
  Coord first = point, last = point;
  first[mAxis] = std::clamp(point[mAxis], 0, static_cast<std::int32_t>(kMask));
  last[mAxis] = std::clamp(point[mAxis] + count, 0, static_cast<std::int32_t>(kMask));
  const auto before = [](const EdgeCrossing& c, std::uint64_t edge) { return c.edge < edge; };
  const auto begin = std::lower_bound(mCrossings.begin(), mCrossings.end(), edgeKey(first), before);
  auto end = begin;
  for (const std::uint64_t limit = edgeKey(last); end != mCrossings.end() && end->edge < limit;) ++end;
  return {begin, end};
}

LatticeWinding::LatticeWinding(const LatticeCrossings& crossings) : mCrossings(crossings) {
  const auto all = crossings.all();
  mAbove.resize(all.size());
  std::int32_t number = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].edge >> kBits != all[i - 1].edge >> kBits) number = 0;
    mAbove[i] = number -= all[i].turn;
  }
}

void LatticeWinding::read(const Coord& point, int count, std::int32_t* numbers) const {
  const auto all = mCrossings.all();
  const auto passed = mCrossings.along(point, count - 1);
  // Where the line is not there at all, `passed` says nothing of a place in the list.
  std::int32_t number = 0;
  if (passed.data() != nullptr) {
    const auto next = static_cast<std::size_t>(passed.data() - all.data());
    if (next > 0) {
      const Coord before = mCrossings.pointOf(all[next - 1].edge);
      if (before[0] == point[0] && before[1] == point[1]) number = mAbove[next - 1];
    }
  }
  auto crossing = passed.begin();
  for (int i = 0; i < count; ++i) {
    while (crossing != passed.end() && mCrossings.pointOf(crossing->edge)[2] < point[2] + i) {
      number -= crossing->turn;
      ++crossing;
    }
    numbers[i] = number;
  }
}

}  // namespace pdc::detail
