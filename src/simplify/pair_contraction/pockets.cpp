#include "simplify/pair_contraction/pockets.h"

#include <algorithm>
#include <optional>

namespace pdc::detail {
namespace {

/// The faces at one end, found by the directed edge that lies opposite to it or by the vertices that leave it.
class EndFaces {
 public:
  /// \param other the end that it meets.
  EndFaces(std::span<const StarCorner> star, const std::vector<Vec3d>& positions, std::uint32_t end,
           std::uint32_t other)
      : mPositions(positions), mEnd(end), mOther(other), mByNext(star.begin(), star.end()) {
    std::sort(mByNext.begin(), mByNext.end(), [](const StarCorner& x, const StarCorner& y) {
      return x.next != y.next ? x.next < y.next : x.previous < y.previous;
    });
  }

  /// The faces at the star's vertex whose edge from it runs to `next`.
  [[nodiscard]] std::span<const StarCorner> towards(std::uint32_t next) const {
    const auto [begin, end] = std::equal_range(mByNext.begin(), mByNext.end(), StarCorner{0, next, 0},
                                               [](const auto& x, const auto& y) { return x.next < y.next; });
    return {begin, end};
  }
  [[nodiscard]] const StarCorner* find(std::uint32_t next, std::uint32_t previous) const {
    for (const StarCorner& c : towards(next))
      if (c.previous == previous) return &c;
    return nullptr;
  }
  /// Whether a face looks towards the other end.
  [[nodiscard]] bool facesOther(const StarCorner& c) const {
    const Vec3d& p = mPositions[mEnd];
    return dot(cross(mPositions[c.next] - p, mPositions[c.previous] - p), mPositions[mOther] - p) > 0;
  }
  [[nodiscard]] std::span<const StarCorner> all() const { return mByNext; }

 private:
  const std::vector<Vec3d>& mPositions;
  const std::uint32_t mEnd, mOther;
  std::vector<StarCorner> mByNext;
};

/// The face whose corners follow each other in this order.
std::optional<std::uint32_t> findFace(const LinkedFaces& faces, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::optional<std::uint32_t> found;
  faces.forEachCommon(x, y, [&](std::uint32_t f) {
    const Triangle& t = faces[f];
    for (int k = 0; k < 3; ++k)
      if (t[k] == x && t[(k + 1) % 3] == y && t[(k + 2) % 3] == z) found = f;
  });
  return found;
}

/// Three faces of a tetrahedron.
struct Pocket {
  std::uint32_t first, second, base;  ///< Two of the other end, and one of neither.
};

/// Finds the other three faces of the tetrahedron that a face at one end belongs to, if there is one whose faces look
/// inwards.
std::optional<Pocket> findPocket(const LinkedFaces& faces, const EndFaces& own, const StarCorner& c,
                                 const EndFaces& others) {
  if (!own.facesOther(c)) return std::nullopt;
  for (const StarCorner& first : others.towards(c.previous)) {
    const std::uint32_t tip = first.previous;
    if (faces.isRemoved(first.face) || !others.facesOther(first)) continue;
    const StarCorner* const second = others.find(tip, c.next);
    if (second == nullptr || faces.isRemoved(second->face) || !others.facesOther(*second)) continue;
    if (const auto base = findFace(faces, c.previous, c.next, tip)) return Pocket{first.face, second->face, *base};
  }
  return std::nullopt;
}

}  // namespace

RemovedPockets removePockets(LinkedFaces& faces, const std::vector<Vec3d>& positions, const MergingEnds& ends) {
  RemovedPockets removed;
  const std::size_t before = faces.size();
  const EndFaces atA(ends.starA, positions, ends.a, ends.b), atB(ends.starB, positions, ends.b, ends.a);
  for (const StarCorner& c : atB.all()) {
    if (const StarCorner* const same = atA.find(c.next, c.previous); same != nullptr) {
      faces.remove(c.face);
    } else if (const StarCorner* const opposite = atA.find(c.previous, c.next); opposite != nullptr) {
      faces.remove(c.face);
      if (!atB.facesOther(c) || !atA.facesOther(*opposite)) continue;
      faces.remove(opposite->face);
      removed.corners.insert(removed.corners.end(), {c.next, c.previous});
    }
  }
  const auto removeTetrahedra = [&](const EndFaces& own, const EndFaces& others) {
    for (const StarCorner& c : own.all()) {
      if (faces.isRemoved(c.face)) continue;
      const auto pocket = findPocket(faces, own, c, others);
      if (!pocket) continue;
      removed.away.push_back(faces[pocket->base]);
      removed.corners.insert(removed.corners.end(), removed.away.back().begin(), removed.away.back().end());
      for (const std::uint32_t f : {c.face, pocket->first, pocket->second, pocket->base}) faces.remove(f);
    }
  };
  removeTetrahedra(atA, atB);
  removeTetrahedra(atB, atA);
  removed.faces = before - faces.size();
  return removed;
}

}  // namespace pdc::detail
