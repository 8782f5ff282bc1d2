#include "pdc/mesh/weld_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <variant>
#include <vector>

#include "mesh/faces.h"
#include "mesh/mesh_checks.h"

namespace pdc {
namespace {

using detail::isFinite;

constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

/// Distinct floats are farther apart than anything less.
constexpr double kLeastGap = std::numeric_limits<float>::denorm_min();

/// The edge of the smaller cells over the distance: their diagonals are just below it, so that all that one holds
/// becomes one without a look at each pair.
constexpr double kSmallCell = 0.577;
/// So many small cells make the edge of a large one. It is longer than twice the distance, so that what is near a
/// point lies in eight large cells at most.
constexpr double kSmallPerLarge = 4;

/// A cell of a grid: whole numbers, as doubles because there is no bound to them. Beyond 2^53, where doubles are even,
/// floats are farther apart than cells are wide.
using Cell = std::array<double, 3>;

/// Lists of numbers by cell. Open addressing, at most half full.
class CellLists {
 public:
  explicit CellLists(std::size_t most)
      : mNext(most, kNone), mSlots(std::bit_ceil(2 * most + 1)), mMask(mSlots.size() - 1) {}

  /// Puts a number, which is less than `most`, in front of its cell's list. \returns what was in front before, or
  /// kNone.
  std::uint32_t add(const Cell& cell, std::uint32_t number) {
    Slot& slot = mSlots[find(cell)];
    slot.cell = cell;
    mNext[number] = slot.first;
    return std::exchange(slot.first, number);
  }
  [[nodiscard]] std::uint32_t first(const Cell& cell) const { return mSlots[find(cell)].first; }
  [[nodiscard]] std::uint32_t next(std::uint32_t number) const { return mNext[number]; }

 private:
  struct Slot {
    Cell cell{};
    std::uint32_t first = kNone;
  };

  [[nodiscard]] std::size_t find(const Cell& cell) const {
    std::size_t at = hash(cell) & mMask;
    while (mSlots[at].first != kNone && mSlots[at].cell != cell) at = (at + 1) & mMask;
    return at;
  }
  static std::uint64_t hash(const Cell& cell) {
    std::uint64_t h = 0;
    for (const double c : cell) {
      h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio; -0 + 0 is 0.
      h ^= h >> 32;
    }
    return h;
  }

  std::vector<std::uint32_t> mNext;
  std::vector<Slot> mSlots;
  std::size_t mMask;
};

/// Which vertices become one.
class Welding {
 public:
  Welding(const Buffer<Vec3f>& positions, double distance)
      : mPositions(positions), mDistance(distance < kLeastGap ? 0 : distance), mRoot(positions.size()) {
    std::iota(mRoot.begin(), mRoot.end(), 0U);
  }

  /// \returns by vertex, the least one of those that it becomes one with.
  std::vector<std::uint32_t> run(const Monitor& monitor) {
    CellLists small(mPositions.size());
    for (std::uint32_t v = 0; v < mPositions.size(); ++v) {
      if (!isFinite(mPositions[v])) continue;
      const std::uint32_t other = small.add(smallCell(v), v);
      if (other != kNone) unite(v, other);
    }
    monitor.throwIfStopped();
    if (mDistance > 0) uniteNear(small, monitor);
    for (std::uint32_t v = 0; v < mRoot.size(); ++v) mRoot[v] = root(v);
    return std::move(mRoot);
  }

 private:
  [[nodiscard]] Cell smallCell(std::uint32_t v) const {
    const Vec3f& p = mPositions[v];
    return mDistance > 0 ? cellOf(vecCast<double>(p), kSmallCell * mDistance) : Cell{p.x, p.y, p.z};
  }
  static Cell cellOf(const Vec3d& p, double edge) {
    return {std::floor(p.x / edge), std::floor(p.y / edge), std::floor(p.z / edge)};
  }
  static Cell largeCell(const Cell& small) {
    return {std::floor(small[0] / kSmallPerLarge), std::floor(small[1] / kSmallPerLarge),
            std::floor(small[2] / kSmallPerLarge)};
  }

  /// Unites what is near in other small cells. A list of a small cell stands for all of its vertices, which are one
  /// already; large cells list the first vertices of small ones.
  void uniteNear(const CellLists& small, const Monitor& monitor) {
    constexpr std::uint32_t kPerLook = 1U << 16;
    CellLists large(mPositions.size());
    for (std::uint32_t v = 0; v < mPositions.size(); ++v) {
      if (v % kPerLook == 0) monitor.throwIfStopped();
      if (!isFinite(mPositions[v])) continue;
      const Cell cell = smallCell(v);
      if (small.first(cell) == v) large.add(largeCell(cell), v);
    }
    for (std::uint32_t v = 0; v < mPositions.size(); ++v) {
      if (v % kPerLook == 0) monitor.throwIfStopped();
      if (isFinite(mPositions[v])) uniteAround(v, small, large);
    }
  }

  void uniteAround(std::uint32_t v, const CellLists& small, const CellLists& large) {
    const Vec3d p = vecCast<double>(mPositions[v]), reach{mDistance, mDistance, mDistance};
    const double edge = kSmallCell * mDistance;
    const Cell low = largeCell(cellOf(p - reach, edge)), high = largeCell(cellOf(p + reach, edge));
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool again = false;  // The box around the point may be in one layer of cells.
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) == 0) continue;
        cell[axis] = high[axis];
        again = again || low[axis] == high[axis];
      }
      if (again) continue;
      for (std::uint32_t i = large.first(cell); i != kNone; i = large.next(i))
        if (root(i) != root(v) && isNear(p, i, small)) unite(i, v);
    }
  }

  /// Whether a vertex of a small cell's list lies near.
  [[nodiscard]] bool isNear(const Vec3d& p, std::uint32_t list, const CellLists& small) const {
    for (std::uint32_t i = list; i != kNone; i = small.next(i)) {
      const Vec3d gap = vecCast<double>(mPositions[i]) - p;
      if (dot(gap, gap) <= mDistance * mDistance) return true;
    }
    return false;
  }

  std::uint32_t root(std::uint32_t v) {
    while (mRoot[v] != v) v = mRoot[v] = mRoot[mRoot[v]];
    return v;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(a), rb = root(b);
    mRoot[std::max(ra, rb)] = std::min(ra, rb);
  }

  const Buffer<Vec3f>& mPositions;
  const double mDistance;
  std::vector<std::uint32_t> mRoot;
};

/// Keeps of an array what belongs to the vertices that are left, `components` numbers each.
template <typename Values>
void keepRoots(Values& values, const std::vector<std::uint32_t>& root, std::size_t components) {
  std::size_t kept = 0;
  for (std::size_t v = 0; v < root.size(); ++v) {
    if (root[v] != v) continue;
    for (std::size_t i = 0; i < components; ++i) values[kept * components + i] = values[v * components + i];
    ++kept;
  }
  values.resize(kept * components);
}

template <typename Face>
bool isWhole(const Face& face) {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (std::count(face.begin(), face.end(), face[i]) > 1) return false;
  return true;
}

/// Gives faces the numbers of the vertices that are left. \returns how many faces are dropped, because welding left
/// less than three of their corners.
std::size_t renumberFaces(Mesh& mesh, const std::vector<std::uint32_t>& number) {
  const std::size_t before = detail::faceCount(mesh);
  const auto numbered = [&](auto face) {
    for (std::uint32_t& v : face) v = number[v];
    return face;
  };
  Buffer<Quad> quads;
  Buffer<Triangle> triangles;
  for (const Quad& given : mesh.quads) {
    const Quad q = numbered(given);
    const Triangle first{q[0], q[1], q[2]}, second{q[0], q[2], q[3]};
    if (isWhole(q) || !isWhole(given)) {
      quads.push_back(q);
    } else if (q[1] != q[3] && (isWhole(first) || isWhole(second))) {
      triangles.push_back(isWhole(first) ? first : second);
    }
  }
  for (const Triangle& given : mesh.triangles) {
    const Triangle t = numbered(given);
    if (isWhole(t) || !isWhole(given)) triangles.push_back(t);
  }
  mesh.quads = std::move(quads);
  mesh.triangles = std::move(triangles);
  return before - detail::faceCount(mesh);
}

}  // namespace

WeldReport weldVertices(Mesh& mesh, double distance, const Monitor& monitor) {
  if (!(distance >= 0 && std::isfinite(distance)))
    throw std::invalid_argument(fmt::format("weldVertices: the distance is {}, not a finite number >= 0", distance));
  detail::checkSizes(mesh, "weldVertices");
  detail::checkIndices(mesh);
  const std::vector<std::uint32_t> root = Welding(mesh.positions, distance).run(monitor);
  std::vector<std::uint32_t> number(root.size());
  std::uint32_t left = 0;
  for (std::size_t v = 0; v < root.size(); ++v) number[v] = root[v] == v ? left++ : number[root[v]];
  WeldReport report;
  report.weldedVertices = root.size() - left;
  if (report.weldedVertices == 0) return report;
  keepRoots(mesh.positions, root, 1);
  if (!mesh.normals.empty()) keepRoots(mesh.normals, root, 1);
  for (VertexProperty& property : mesh.properties)
    std::visit([&](auto& values) { keepRoots(values, root, static_cast<std::size_t>(property.components)); },
               property.values);
  report.collapsedFaces = renumberFaces(mesh, number);
  return report;
}

bool isSoup(const Mesh& mesh) {
  detail::checkSizes(mesh, "isSoup", detail::FaceKinds::kAll);
  detail::checkIndices(mesh);
  const std::size_t faces = detail::faceCount(mesh);
  std::vector<std::size_t> faceOf(mesh.positions.size(), faces);
  for (std::size_t f = 0; f < faces; ++f)
    for (const std::uint32_t v : detail::face(mesh, f)) {
      if (faceOf[v] != faces && faceOf[v] != f) return false;
      faceOf[v] = f;
    }
  return faces > 1;
}

}  // namespace pdc
