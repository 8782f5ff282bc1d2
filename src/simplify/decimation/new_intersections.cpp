#include "simplify/decimation/new_intersections.h"

#include <algorithm>

#include "pdc/mesh/self_intersections.h"

namespace pdc::detail {
namespace {

/// A surface after some collapses. What was about the edge of one is one thing, and so is each other face.
class Collapsed {
 public:
  Collapsed(const DecimatedSurface& surface, const VertexStars& stars, std::span<const ChosenCollapse> collapses)
      : mCollapses(collapses.size()), mPositions(surface.positions), mThing(surface.faces.size()) {
    std::vector<Triangle> all(surface.faces.begin(), surface.faces.end());
    for (std::uint32_t f = 0; f < all.size(); ++f) mThing[f] = static_cast<std::uint32_t>(mCollapses + f);
    for (std::uint32_t i = 0; i < collapses.size(); ++i) {
      const auto& [a, b, to] = collapses[i];
      mPositions[a] = to.place;
      for (const std::uint32_t v : {a, b})
        for (const StarCorner& c : stars[v]) mThing[c.face] = i;
      for (const StarCorner& c : stars[b])
        for (std::uint32_t& v : all[c.face]) v = v == b ? a : v;
    }
    for (std::uint32_t f = 0; f < all.size(); ++f) {
      const auto& [u, v, w] = all[f];
      if (u == v || v == w || w == u) continue;
      mFaces.push_back(all[f]);
      mBefore.push_back(f);
    }
  }

  [[nodiscard]] FacePairs intersections(const DecimatedSurface& surface, const Monitor& monitor) const {
    return intersectingFaces(surface, mPositions, mFaces, monitor);
  }

  /// The things that pairs of faces belong to, the lower first, sorted. \param after whether they are faces that are
  /// left, or such as were there before.
  [[nodiscard]] FacePairs thingsOf(const FacePairs& pairs, bool after) const {
    FacePairs things;
    for (const auto& [f, g] : pairs) {
      const std::uint32_t s = mThing[after ? mBefore[f] : f], t = mThing[after ? mBefore[g] : g];
      things.push_back({std::min(s, t), std::max(s, t)});
    }
    std::sort(things.begin(), things.end());
    return things;
  }
  /// Whether a thing is what a collapse has changed; its number is that of the collapse.
  [[nodiscard]] bool isCollapse(std::uint32_t thing) const { return thing < mCollapses; }

 private:
  std::size_t mCollapses;
  std::vector<Vec3d> mPositions;
  std::vector<std::uint32_t> mThing;  ///< By face before.
  std::vector<Triangle> mFaces;
  std::vector<std::uint32_t> mBefore;  ///< By face that is left, its number before.
};

/// By collapse, whether it makes things intersect that did not before.
std::vector<std::uint8_t> findBad(const Collapsed& after, const FacePairs& before, const FacePairs& now,
                                  std::size_t collapses) {
  std::vector<std::uint8_t> bad(collapses, 0);
  const FacePairs known = after.thingsOf(before, false);
  for (const auto& pair : after.thingsOf(now, true)) {
    if (std::binary_search(known.begin(), known.end(), pair)) continue;
    for (const std::uint32_t thing : pair)
      if (after.isCollapse(thing)) bad[thing] = 1;
  }
  return bad;
}

}  // namespace

FacePairs intersectingFaces(const DecimatedSurface& surface, std::span<const Vec3d> positions,
                            std::span<const Triangle> faces, const Monitor& monitor) {
  Mesh mesh;
  mesh.positions.reserve(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) mesh.positions.push_back(surface.written(v, positions[v]));
  mesh.triangles.assign(faces.begin(), faces.end());
  return selfIntersections(mesh, {}, {.progress = {}, .stop = monitor.stop}).pairs;
}

std::vector<ChosenCollapse> takeOutIntersecting(const DecimatedSurface& surface, const VertexStars& stars,
                                                std::vector<ChosenCollapse>& collapses, FacePairs& pairs,
                                                const Monitor& monitor) {
  std::vector<ChosenCollapse> out;
  while (!collapses.empty()) {
    const Collapsed after(surface, stars, collapses);
    FacePairs now = after.intersections(surface, monitor);
    const std::vector<std::uint8_t> bad = findBad(after, pairs, now, collapses.size());
    std::vector<ChosenCollapse> kept;
    for (std::size_t i = 0; i < collapses.size(); ++i) (bad[i] != 0 ? out : kept).push_back(collapses[i]);
    const bool all = kept.size() == collapses.size();
    collapses.swap(kept);
    if (!all) continue;
    pairs.swap(now);
    break;
  }
  return out;
}

}  // namespace pdc::detail
