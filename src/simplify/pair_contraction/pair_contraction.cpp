#include "simplify/pair_contraction/pair_contraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include "parallel/for_each_in_parallel.h"
#include "pdc/error.h"
#include "simplify/pair_contraction/close_vertices.h"
#include "simplify/pair_contraction/pockets.h"
#include "simplify/vertex_pair_hash.h"

namespace pdc::detail {
namespace {

/// Costs at or below this, in mean edge lengths to the fourth power, are rounding.
constexpr float kNoCost = 1e-14F;

/// So many pairs are tried between two looks at whether to stop.
constexpr std::size_t kTrialsBetweenLooks = 4096;

/// The vertices to which a star has one face only, in order.
std::vector<std::uint32_t> boundaryNeighbours(std::span<const StarCorner> star) {
  std::vector<std::uint32_t> all, once;
  for (const StarCorner& c : star) all.insert(all.end(), {c.next, c.previous});
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((i == 0 || all[i - 1] != all[i]) && (i + 1 == all.size() || all[i + 1] != all[i])) once.push_back(all[i]);
  return once;
}

/// The far ends of boundary edges of two stars that become one edge when their vertices become one.
std::vector<std::uint32_t> sewnNeighbours(std::span<const StarCorner> starA, std::span<const StarCorner> starB) {
  const std::vector<std::uint32_t> atA = boundaryNeighbours(starA), atB = boundaryNeighbours(starB);
  std::vector<std::uint32_t> sewn;
  std::set_intersection(atA.begin(), atA.end(), atB.begin(), atB.end(), std::back_inserter(sewn));
  return sewn;
}

}  // namespace

PairContraction::PairContraction(std::vector<Vec3d>& positions, Buffer<Triangle>& faces,
                                 InterpolatedProperties& properties, const PairContractionRule& rule)
    : mPositions(positions),
      mGiven(faces),
      mProperties(properties),
      mRule(rule),
      mDuplicates(removeDuplicates(faces)),
      mFaces(faces, positions.size()),
      mPairs(positions.size()),
      mLocked(positions.size()),
      mRefused(positions.size()),
      mCollapse(positions, mQuadrics, mLocked),
      mMarks(positions.size()),
      mManifolds(positions.size()) {
  mCollapse.classical = rule.quadrics.classical();
  mCollapse.subset = rule.subset;
}

void PairContraction::run(const Monitor& monitor) {
  const std::size_t before = mFaces.size(), wanted = before - std::min(before, mRule.targetFaces);
  if (wanted == 0) return;
  findQuadrics();
  findPairs(monitor);
  fillQueue();
  for (std::size_t trials = 0; mFaces.size() > mRule.targetFaces && !mQueue.empty(); ++trials) {
    if (trials % kTrialsBetweenLooks == 0) {
      monitor.throwIfStopped();
      if (monitor.progress)
        monitor.progress("decimate", static_cast<double>(before - mFaces.size()) / static_cast<double>(wanted));
    }
    const Candidate candidate = pop();
    if (mPairs.isRemoved(candidate.pair)) continue;
    const std::optional<Trial> trial = tryPair(candidate.pair);
    if (!trial) {
      mPairs.remove(candidate.pair);
      continue;
    }
    // Quadrics only grow, and costs with them: what was found earlier is a lower bound.
    const Candidate now = candidateOf(candidate.pair, *trial);
    if (now.cost > candidate.cost && !mQueue.empty() && now > mQueue.front()) {
      push(now);
    } else if (isAllowed(*trial)) {
      contract(*trial);
    } else {
      mRefused[trial->a] = mRefused[trial->b] = 1;
    }
  }
  mGiven = mFaces.left();
}

/// Finds what the faces given say of each vertex, and which vertices stay.
void PairContraction::findQuadrics() {
  VertexStars stars;
  stars.build(mGiven, mPositions.size());
  Buffer<FaceArea> areas(mGiven.size());
  forEachInParallel(mGiven.size(), 1024, [&](std::uint32_t f) {
    const Triangle& t = mGiven[f];
    areas[f] = FaceArea(mPositions[t[0]], mPositions[t[1]], mPositions[t[2]]);
  });
  mQuadrics.resize(mPositions.size());
  forEachInParallel(mPositions.size(), 1024, [&](std::uint32_t v) {
    const std::span<const StarCorner> star = stars[v];
    mQuadrics[v] = quadricOf(v, star, areas);
    if (mRule.lockBoundary) lockBoundary(v, star);
  });
}

/// \param areas by face of the star.
VertexQuadric PairContraction::quadricOf(std::uint32_t vertex, std::span<const StarCorner> star,
                                         const Buffer<FaceArea>& areas) const {
  VertexQuadric sum = vertexQuadric(vertex, star, mPositions, areas, mRule.quadrics);
  // Several fans may hide their boundaries from it.
  if (!atBoundary(star)) addBoundary(sum, mPositions[vertex], star, mPositions, areas, mRule.quadrics);
  return sum;
}

void PairContraction::lockBoundary(std::uint32_t vertex, std::span<const StarCorner> star) {
  for (const StarCorner& c : star)
    for (const std::uint32_t other : {c.next, c.previous}) {
      std::size_t faces = 0;
      for (const StarCorner& o : star) faces += o.next == other || o.previous == other;
      if (faces == 1) mLocked[vertex] = 1;
    }
}

/// Finds all edges and all vertices that are close to each other.
void PairContraction::findPairs(const Monitor& monitor) {
  std::vector<std::uint8_t> used(mPositions.size());
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < used.size(); ++v) count += used[v] = mFaces.hasFaces(v);
  const std::size_t most = std::min<std::size_t>(kMostPairs * count, std::numeric_limits<std::uint32_t>::max());
  const CloseVertices closeVertices(mPositions, used, mRule.distance);
  std::vector<std::uint32_t> joined, close, all;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (v % kTrialsBetweenLooks == 0) monitor.throwIfStopped();
    if (used[v] == 0) continue;
    joined.clear();
    close.clear();
    all.clear();
    mFaces.findStar(v, mStarA);
    for (const StarCorner& c : mStarA)
      for (const std::uint32_t other : {c.next, c.previous})
        if (other > v) joined.push_back(other);
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    closeVertices.addAbove(v, close);
    std::set_union(joined.begin(), joined.end(), close.begin(), close.end(), std::back_inserter(all));
    if (mPairs.size() + all.size() > most)
      throw Error(
          fmt::format("pair distance: more than {} pairs of vertices are within {:.3g} mean edge lengths; the "
                      "limit is {} per vertex",
                      most, mRule.distance, kMostPairs));
    for (const std::uint32_t other : all) mPairs.add(v, other, std::binary_search(close.begin(), close.end(), other));
  }
}

/// Finds what each pair costs.
void PairContraction::fillQueue() {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  mQueue.resize(mPairs.size());
  forEachInParallel(mPairs.size(), 1024, [&](std::uint32_t p) {
    const std::optional<Trial> trial = tryPair(p);
    mQueue[p] = trial ? candidateOf(p, *trial) : Candidate{kNever, 0, p};
  });
  for (const Candidate& c : mQueue) mPairs.setQueued(c.pair, true);
  std::make_heap(mQueue.begin(), mQueue.end(), std::greater<>());
}

/// Nothing for pairs that can never be contracted.
std::optional<PairContraction::Trial> PairContraction::tryPair(std::uint32_t pair) const {
  Trial trial{mPairs.lower(pair), mPairs.higher(pair), false, 0, {}};
  const auto [a, b] = std::pair(trial.a, trial.b);
  if (mLocked[a] != 0 && mLocked[b] != 0) return std::nullopt;
  Vec3d between{};
  mFaces.forEachCommon(a, b, [&](std::uint32_t f) {
    const Triangle& t = mFaces[f];
    between += cross(mPositions[t[1]] - mPositions[t[0]], mPositions[t[2]] - mPositions[t[0]]);
    trial.isEdge = true;
  });
  if (!trial.isEdge && (!mPairs.isClose(pair) || !mFaces.hasFaces(a) || !mFaces.hasFaces(b))) return std::nullopt;
  trial.to = mCollapse.collapse(a, b, between, trial.isEdge);
  trial.cost = std::max(kNoCost, static_cast<float>(trial.to.cost));
  return trial;
}

PairContraction::Candidate PairContraction::candidateOf(std::uint32_t pair, const Trial& trial) const {
  return {trial.cost, vertexPairHash(trial.a, trial.b), pair};
}

void PairContraction::enqueue(std::uint32_t pair) {
  if (const std::optional<Trial> trial = tryPair(pair))
    push(candidateOf(pair, *trial));
  else
    mPairs.remove(pair);
}

void PairContraction::push(const Candidate& candidate) {
  mPairs.setQueued(candidate.pair, true);
  mQueue.push_back(candidate);
  std::push_heap(mQueue.begin(), mQueue.end(), std::greater<>());
}

PairContraction::Candidate PairContraction::pop() {
  std::pop_heap(mQueue.begin(), mQueue.end(), std::greater<>());
  const Candidate candidate = mQueue.back();
  mQueue.pop_back();
  mPairs.setQueued(candidate.pair, false);
  return candidate;
}

bool PairContraction::isAllowed(const Trial& trial) {
  const auto& [a, b, isEdge, cost, to] = trial;
  mFaces.findStar(a, mStarA);
  mFaces.findStar(b, mStarB);
  mStaysManifold = isEdge && mManifolds.isManifold(mStarA) && mManifolds.isManifold(mStarB);
  if (mStaysManifold && !mManifolds.keepsTopology(mStarA, mStarB, a, b)) return false;
  return keepsFaces(mStarA, mPositions, mPositions[a], to.place, b, mRule.leastCosine) &&
         keepsFaces(mStarB, mPositions, mPositions[b], to.place, a, mRule.leastCosine);
}

/// \pre isAllowed(trial) was called last.
void PairContraction::contract(const Trial& trial) {
  const auto& [a, b, isEdge, cost, to] = trial;
  std::vector<Vec3d>& p = mPositions;
  std::vector<std::uint32_t> changed;
  if (!mStaysManifold) changed = sewnNeighbours(mStarA, mStarB);
  removeFacesBetween(trial);
  addFaces(mStarA, -1);
  addFaces(mStarB, -1);
  if (!mStaysManifold) {
    const RemovedPockets removed = removePockets(mFaces, p, {a, b, mStarA, mStarB});
    mDuplicates += removed.faces;
    for (const Triangle& t : removed.away) addFace(t, -1);
    changed.insert(changed.end(), removed.corners.begin(), removed.corners.end());
  }
  mFaces.merge(a, b);
  mPairs.merge(a, b, mMarks);

  const Vec3d along = p[b] - p[a];
  const double l = dot(along, along), share = l > 0 ? std::clamp(dot(to.place - p[a], along) / l, 0.0, 1.0) : 0.5;
  mProperties.blend(a, b, share);
  mQuadrics[a].q = mQuadrics[a].q.relativeTo(to.place - p[a]) + mQuadrics[b].q.relativeTo(to.place - p[b]);
  mLocked[a] = mLocked[a] | mLocked[b];
  p[a] = to.place;
  mFaces.findStar(a, mStarA);
  mQuadrics[a].weight = 0;
  mQuadrics[a].vectorArea = {};
  addFaces(mStarA, 1);
  if (!changed.empty()) {
    changed.push_back(a);
    forget(std::move(changed));
  }
  ++mContractions;
  mMerges += !isEdge;
  mLimitedMoves += to.limited;
  enqueueAround(a);
}

/// Removes the faces of both ends, from their stars, too.
void PairContraction::removeFacesBetween(const Trial& trial) {
  const auto isBetween = [](std::uint32_t other) {
    return [other](const StarCorner& c) { return c.next == other || c.previous == other; };
  };
  for (const StarCorner& c : mStarA) {
    if (!isBetween(trial.b)(c)) continue;
    addFace(mFaces[c.face], -1);
    mFaces.remove(c.face);
  }
  std::erase_if(mStarA, isBetween(trial.b));
  std::erase_if(mStarB, isBetween(trial.a));
}

/// Adds what a face weighs to its vertices, or takes it away. What faces weigh now is one thing, what those given say
/// of places another: that stays in the quadrics.
void PairContraction::addFace(const Triangle& t, double sign) {
  const FaceArea area(mPositions[t[0]], mPositions[t[1]], mPositions[t[2]]);
  const double weight = mRule.quadrics.ofTriangles() ? area.size * area.size : area.size;
  for (const std::uint32_t v : t) {
    mQuadrics[v].vectorArea += area.vector * sign;
    mQuadrics[v].weight = std::max(0.0, mQuadrics[v].weight + weight * sign);
  }
}

void PairContraction::addFaces(std::span<const StarCorner> star, double sign) {
  for (const StarCorner& c : star) addFace(mFaces[c.face], sign);
}

/// Gives vertices the quadrics of the faces they have: or boundaries and walls that are gone would go on to hold them.
void PairContraction::forget(std::vector<std::uint32_t> vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Buffer<FaceArea> areas;
  for (const std::uint32_t v : vertices) {
    mFaces.findStar(v, mStarB);
    areas.resize(mStarB.size());
    for (std::uint32_t i = 0; i < mStarB.size(); ++i) {
      StarCorner& c = mStarB[i];
      areas[i] = FaceArea(mPositions[v], mPositions[c.next], mPositions[c.previous]);
      c.face = i;
    }
    mQuadrics[v] = quadricOf(v, mStarB, areas);
  }
  // Their pairs are in the queue with costs that are too high. Those are met again when the pairs are done with.
  for (const std::uint32_t v : vertices) mPairs.forEach(v, [&](std::uint32_t pair, std::uint32_t) { enqueue(pair); });
}

/// Puts those pairs back into the queue that a contraction into a vertex may have made possible.
void PairContraction::enqueueAround(std::uint32_t vertex) {
  const auto enqueueOf = [&](std::uint32_t v) {
    mRefused[v] = 0;
    mPairs.forEach(v, [&](std::uint32_t pair, std::uint32_t) {
      if (!mPairs.isQueued(pair)) enqueue(pair);
    });
  };
  enqueueOf(vertex);
  for (const StarCorner& c : mStarA)
    for (const std::uint32_t v : {c.next, c.previous})
      if (mRefused[v] != 0) enqueueOf(v);
}

}  // namespace pdc::detail
