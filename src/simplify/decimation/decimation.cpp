#include "simplify/decimation/decimation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/lane_loops.h"
#include "parallel/for_each_in_parallel.h"
#include "parallel/gather.h"
#include "simplify/decimation/collapse_checks.h"
#include "simplify/decimation/edge_lanes.h"
#include "simplify/decimation/new_intersections.h"
#include "simplify/error_bound/hub.h"
#include "simplify/vertex_pair_hash.h"

namespace pdc::detail {
namespace {

/// The number of edges looked at in a round, those of least cost, as a share of the vertices. With a fifth means of
/// distances are at most one percent less and decimation takes half as long again.
constexpr double kShareOfRound = 0.6;
/// At least so many are looked at. More of a small mesh would let edges that cost much go before others that are beside
/// a collapse.
constexpr std::size_t kLeastOfRound = 2;

/// An edge that costs so many times more than one that has to wait for its neighbour waits, too. Flat parts cost next
/// to nothing: without this the last rounds took corners of one in seventeen plates of 200 to 26,000 faces with
/// classical quadrics, while edges beside their collapses waited. Scans and CAD parts come out as before.
constexpr float kMostAhead = 1e8F;

/// Costs at or below this, in mean edge lengths to the fourth power, are rounding.
constexpr float kNoCost = 1e-14F;

/// So many edges are looked at at a time to see which may be collapsed.
constexpr std::size_t kBlock = 2048;

constexpr float kNever = std::numeric_limits<float>::infinity();

template <typename Visit>
void forEachWithSimd(std::size_t n, std::size_t grain, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain), [&](const auto& r) {
    withSimd(bestSimdLevel(), [&] {
      for (std::size_t i = r.begin(); i < r.end(); ++i) visit(i);
    });
  });
}

}  // namespace

Decimation::Decimation(DecimatedSurface& surface, const GivenSurface& given, InterpolatedProperties& properties,
                       const DecimationRule& rule)
    : mSurface(surface),
      mGiven(given),
      mProperties(properties),
      mRule(rule),
      mRemembers(rule.memory > 0 || (surface.noise.known() && rule.memoryOfVertices)),
      mTouched(surface.positions.size(), 0),
      mChanged(rule.mayRefuse() ? surface.positions.size() : 0, 0),
      mFirstCost(mChanged.size(), 0),
      mBecame(surface.positions.size()),
      mCollapse(surface.positions, mQuadrics, surface.locked) {
  std::iota(mBecame.begin(), mBecame.end(), 0U);
  mCollapse.classical = rule.quadrics.classical();
  mCollapse.subset = rule.subset;
  if (rule.error) mTracked.emplace(surface, *rule.error);
}

void Decimation::run(const Monitor& monitor) {
  const std::size_t before = mSurface.faces.size(), wanted = before - std::min(before, mRule.targetFaces);
  std::size_t least = kLeastOfRound;
  if (mRule.sound) mIntersections.emplace(mSurface, monitor);
  while (mSurface.faces.size() > mRule.targetFaces) {
    monitor.throwIfStopped();
    ++mRounds;
    look();
    findCosts();
    const std::size_t left = (mSurface.faces.size() - mRule.targetFaces + 1) / 2;
    const auto share = static_cast<std::size_t>(kShareOfRound * 0.5 * static_cast<double>(mSurface.faces.size()));
    const auto [candidates, all] = cheapest(std::max(least, std::min(share, 2 * left)));
    std::vector<ChosenCollapse> chosen = choose(candidates);
    const bool none = chosen.empty();
    takeOutRefused(chosen, monitor);
    apply(chosen);
    // Where nothing cheap may be collapsed, more is looked at.
    if (none && all && !lookCloser(monitor)) return;
    least = none ? 4 * std::max(least, candidates.size()) : kLeastOfRound;
    if (monitor.progress)
      monitor.progress("decimate", static_cast<double>(before - mSurface.faces.size()) / static_cast<double>(wanted));
  }
}

/// Finds what the faces say of each vertex about which any has changed.
void Decimation::look() {
  const std::vector<Vec3d>& p = mSurface.positions;
  mStars.build(mSurface.faces, p.size());
  mAreas.resize(mSurface.faces.size());
  forEachWithSimd(mSurface.faces.size(), 4096, [&](std::size_t f) {
    const Triangle& t = mSurface.faces[f];
    mAreas[f] = FaceArea(p[t[0]], p[t[1]], p[t[2]]);
    if (mSurface.noise.known()) mAreas[f].trust = mSurface.noise.trust(t, mAreas[f].vector);
  });
  mQuadrics.resize(p.size());
  forEachWithSimd(p.size(), 1024, [&](std::size_t v) {
    const auto vertex = static_cast<std::uint32_t>(v);
    if (mStars[vertex].empty() || !hasChanged(vertex)) return;
    QuadricRule rule = mRule.quadrics;
    if (mSurface.noise.known()) rule.sigmaNormal = noiseOf(vertex).sigmaNormal;
    mQuadrics[v] = vertexQuadric(vertex, mStars[vertex], p, mAreas, rule);
  });
  if (mRemembers) remember();
}

/// What the noise at a vertex asks for, as far as it is known and was left to choose.
NoiseChoice Decimation::noiseOf(std::uint32_t vertex) const {
  const DecimationRule& rule = mRule;
  NoiseChoice choice{rule.quadrics.sigmaNormal, rule.quadrics.sigmaPosition, rule.memory};
  if (!mSurface.noise.known()) return choice;
  Vec3d normal{};
  for (const StarCorner& c : mStars[vertex]) normal += mAreas[c.face].vector;
  const NoiseChoice own = mSurface.noise.choice(vertex, normal);
  if (rule.sigmaNormalOfVertices) choice.sigmaNormal = own.sigmaNormal;
  if (rule.memoryOfVertices) choice.memory = own.memory;
  return choice;
}

/// Mixes what the faces there are say with what those given said.
void Decimation::remember() {
  const std::size_t size = mQuadrics.size();
  const bool first = mAccumulated.empty();
  if (first) mAccumulated.resize(size);
  forEachInParallel(size, 1024, [&](std::size_t v) {
    const auto vertex = static_cast<std::uint32_t>(v);
    if (mStars[vertex].empty() || !hasChanged(vertex)) return;
    if (first) mAccumulated[v] = mQuadrics[v].q;
    const double memory = noiseOf(vertex).memory;
    mQuadrics[v].q = mQuadrics[v].q * (1 - memory) + mAccumulated[v] * memory;
  });
}

EdgeCollapse Decimation::collapseOf(std::uint32_t a, std::uint32_t b) const {
  Vec3d between{};
  for (const StarCorner& c : mStars[a])
    if (c.next == b || c.previous == b) between += mAreas[c.face].vector;
  EdgeCollapse c = mCollapse.collapse(a, b, between);
  // What is tested has to be what is written.
  if (mRule.mayRefuse() && c.place != mSurface.positions[b]) c.place = mSurface.rounded(a, c.place);
  return c;
}

/// Finds what it costs to collapse the edges of some vertices. \param before the costs of the round before, by the
/// corners of that time.
inline void Decimation::findCostsOf(std::uint32_t begin, std::uint32_t end, const Buffer<float>& before) {
  EdgeLanes lanes;
  alignas(64) double costs[kLanes];
  const auto solve = [&] {
    const int size = lanes.solve(costs);
    for (int i = 0; i < size; ++i)
      mCosts[lanes.tag(i)] = costs[i] < 0 ? costAlone(lanes.tag(i)) : std::max(kNoCost, static_cast<float>(costs[i]));
  };
  for (std::uint32_t a = begin; a < end; ++a) {
    const std::span<const StarCorner> star = mStars[a];
    const bool changed = hasChanged(a);
    for (std::size_t k = 0; k < star.size(); ++k) {
      const auto corner = static_cast<std::uint32_t>(mStars.first(a) + k);
      const std::uint32_t b = star[k].next;
      if (!changed && !hasChanged(b)) {
        mCosts[corner] = before[mFirstCost[a] + k];
        continue;
      }
      const StarCorner* const twin = cornerAfter(star, b);
      mCosts[corner] = kNever;
      // The edge is its lower end's, unless it runs towards that only.
      if (b < a && twin != nullptr) continue;
      if (mSurface.locked[a] != 0 && mSurface.locked[b] != 0) continue;
      if (mRule.error && isHub(mStars, a, b)) continue;
      if (!mCollapse.inLanes(a, b)) {
        mCosts[corner] = costAlone(corner);
        continue;
      }
      Vec3d between = mAreas[star[k].face].vector;
      if (twin != nullptr) between += mAreas[twin->face].vector;
      lanes.add(mCollapse, a, b, between, corner);
      if (lanes.full()) solve();
    }
  }
  solve();
}

/// What it costs to collapse the edge that leaves at a corner, without lanes.
float Decimation::costAlone(std::uint32_t corner) const {
  const auto [a, b] = edgeAt(corner);
  return std::max(kNoCost, static_cast<float>(collapseOf(a, b).cost));
}

/// The ends of the edge that leaves at a corner, the lower first.
std::array<std::uint32_t, 2> Decimation::edgeAt(std::uint32_t corner) const {
  const auto [face, next, previous] = mStars.corner(corner);
  const Triangle& t = mSurface.faces[face];
  const std::uint32_t own = t[0] ^ t[1] ^ t[2] ^ next ^ previous;
  return {std::min(own, next), std::max(own, next)};
}

void Decimation::findCosts() {
  mCostsBefore.swap(mCosts);
  mCosts.resize(mStars.cornerCount());
  const tbb::blocked_range<std::uint32_t> all(0, static_cast<std::uint32_t>(mSurface.positions.size()), 512);
  tbb::parallel_for(all, [&](const auto& r) {
    withSimd(bestSimdLevel(), [&] { findCostsOf(r.begin(), r.end(), mCostsBefore); });
    // Ranges do not share vertices, and what was first is not needed any more.
    if (mRule.mayRefuse())
      for (std::uint32_t v = r.begin(); v != r.end(); ++v) mFirstCost[v] = mStars.first(v);
  });
}

/// A cost that about `count` edges have at most.
float Decimation::costOfCheapest(std::size_t count) const {
  // A few thousand of them, evenly spread, tell well enough.
  const std::size_t step = std::max<std::size_t>(1, mCosts.size() / 16384);
  std::vector<float> sample;
  for (std::size_t i = 0; i < mCosts.size(); i += step)
    if (mCosts[i] < kNever) sample.push_back(mCosts[i]);
  if (count / step >= sample.size()) return kNever;
  const auto nth = sample.begin() + static_cast<std::ptrdiff_t>(count / step);
  std::nth_element(sample.begin(), nth, sample.end());
  return *nth;
}

/// About so many of those of least cost, in order.
Decimation::Candidates Decimation::cheapest(std::size_t count) const {
  const float most = costOfCheapest(count);
  constexpr std::size_t kRun = 256;
  std::vector<Candidate> candidates =
      gather<Candidate>((mCosts.size() + kRun - 1) / kRun, [&](std::size_t run, auto& out) {
        for (std::size_t i = run * kRun, end = std::min(mCosts.size(), i + kRun); i < end; ++i) {
          if (!(mCosts[i] <= most) || mCosts[i] == kNever) continue;
          const auto [a, b] = edgeAt(static_cast<std::uint32_t>(i));
          out.push_back({mCosts[i], vertexPairHash(a, b), a, b});
        }
      });
  tbb::parallel_sort(candidates.begin(), candidates.end());
  // Any number of edges may cost the same.
  const bool all = most == kNever && candidates.size() <= 2 * count;
  if (candidates.size() > 2 * count) candidates.resize(2 * count);
  return {std::move(candidates), all};
}

std::size_t Decimation::facesAt(std::uint32_t a, std::uint32_t b) const {
  std::size_t count = 0;
  for (const StarCorner& c : mStars[a]) count += c.next == b || c.previous == b;
  return count;
}

/// Chooses edges that may be collapsed and touch none that is cheaper.
std::vector<ChosenCollapse> Decimation::choose(const std::vector<Candidate>& candidates) {
  const CollapseChecks checks(mStars, mSurface.positions, mAreas, mRule.leastCosine);
  const auto round = static_cast<std::uint32_t>(mRounds);
  const auto touched = [&](const Candidate& c) { return mTouched[c.a] == round || mTouched[c.b] == round; };
  std::vector<ChosenCollapse> chosen;
  std::vector<std::optional<EdgeCollapse>> to(kBlock);
  std::size_t faces = mSurface.faces.size();
  float most = kNever;
  // Block by block, since most of the later ones are touched by earlier ones.
  for (std::size_t first = 0; first < candidates.size() && faces > mRule.targetFaces; first += kBlock) {
    const std::size_t size = std::min(kBlock, candidates.size() - first);
    forEachInParallel(size, 64, [&](std::size_t i) {
      const Candidate& c = candidates[first + i];
      to[i].reset();
      if (touched(c) || !checks.keepsTopology(c.a, c.b)) return;
      const EdgeCollapse collapse = collapseOf(c.a, c.b);
      if (checks.keepsFaces(c.a, c.b, collapse.place)) to[i] = collapse;
    });
    for (std::size_t i = 0; i < size && faces > mRule.targetFaces; ++i) {
      const Candidate& c = candidates[first + i];
      if (c.cost > most) return chosen;
      if (touched(c)) most = std::min(most, kMostAhead * c.cost);
      if (!to[i] || touched(c)) continue;
      for (const std::uint32_t v : {c.a, c.b}) {
        mTouched[v] = round;
        for (const StarCorner& k : mStars[v]) mTouched[k.next] = mTouched[k.previous] = round;
      }
      faces -= facesAt(c.a, c.b);
      // A vertex that takes the other in without moving keeps its number, and its place to the bit.
      const bool toB = to[i]->place == mSurface.positions[c.b];
      chosen.push_back({toB ? c.b : c.a, toB ? c.a : c.b, *to[i]});
    }
  }
  return chosen;
}

/// Lets edges wait until a collapse touches an end. \returns how many there are.
std::size_t Decimation::refuse(const std::vector<ChosenCollapse>& collapses) {
  for (const ChosenCollapse& c : collapses)
    for (const auto& [v, other] : {std::array{c.a, c.b}, std::array{c.b, c.a}})
      for (std::uint32_t k = 0; k < mStars[v].size(); ++k)
        if (mStars[v][k].next == other) mCosts[mStars.first(v) + k] = kNever;
  return collapses.size();
}

/// From adding up what collapses do to looking at the surface given, which takes far longer and lets more be done.
/// \returns whether there is anything to look at more closely.
bool Decimation::lookCloser(const Monitor& monitor) {
  if (!mTracked) return false;
  mTracked.reset();
  mBound.emplace(mGiven.faces, mSurface, *mRule.error, monitor);
  std::fill(mChanged.begin(), mChanged.end(), static_cast<std::uint32_t>(mRounds));
  return true;
}

/// Takes out collapses after which the surface would not be what it has to be.
void Decimation::takeOutRefused(std::vector<ChosenCollapse>& chosen, const Monitor& monitor) {
  if (mTracked) mErrorRefusals += refuse(mTracked->takeOutFar(mStars, chosen));
  if (mBound) mErrorRefusals += refuse(mBound->takeOutFar(mStars, chosen, monitor));
  if (mIntersections) {
    const std::vector<ChosenCollapse> all = chosen, impossible = mIntersections->takeOut(mStars, chosen, monitor);
    // Where all only wait for each other none would ever go on.
    mIntersectionRefusals += refuse(chosen.empty() ? all : impossible);
  }
  if (mBound) mErrorRefusals += refuse(mBound->join(mStars, chosen));
}

/// Their stars have no face in common, so that they do not see each other.
void Decimation::apply(const std::vector<ChosenCollapse>& chosen) {
  if (mTracked) mTracked->accept(mStars, chosen);
  if (mIntersections) mIntersections->accept(mStars, chosen);
  if (mBound) mBound->accept(mStars);
  std::vector<Vec3d>& p = mSurface.positions;
  forEachInParallel(chosen.size(), 64, [&](std::size_t i) {
    const auto& [a, b, to] = chosen[i];
    const Vec3d along = p[b] - p[a];
    const double l = dot(along, along), share = l > 0 ? std::clamp(dot(to.place - p[a], along) / l, 0.0, 1.0) : 0.5;
    mProperties.blend(a, b, share);
    if (mSurface.noise.known()) mSurface.noise.merge(a, b);
    if (mRemembers)
      mAccumulated[a] = mAccumulated[a].relativeTo(to.place - p[a]) + mAccumulated[b].relativeTo(to.place - p[b]);
    p[a] = to.place;
    mBecame[b] = a;
    mSurface.locked[a] = mSurface.locked[a] | mSurface.locked[b];
    for (const StarCorner& c : mStars[b]) {
      Triangle& t = mSurface.faces[c.face];
      const bool vanishes = c.next == a || c.previous == a;
      for (std::uint32_t& v : t) v = vanishes || v == b ? a : v;
    }
  });
  removeVanished();
  if (mRule.mayRefuse())
    for (const ChosenCollapse& c : chosen)
      for (const std::uint32_t v : {c.a, c.b})
        for (const StarCorner& k : mStars[v])
          mChanged[v] = mChanged[k.next] = mChanged[k.previous] = static_cast<std::uint32_t>(mRounds);
  mCollapses += chosen.size();
  for (const ChosenCollapse& c : chosen) mLimitedMoves += c.to.limited;
}

void Decimation::removeVanished() {
  std::uint32_t kept = 0;
  for (std::uint32_t f = 0; f < mSurface.faces.size(); ++f) {
    const Triangle& t = mSurface.faces[f];
    if (t[0] == t[1] && t[1] == t[2]) continue;
    if (mTracked) mTracked->renumber(f, kept);
    if (mIntersections) mIntersections->renumber(f, kept);
    if (mBound) mBound->renumber(f, kept);
    mSurface.faces[kept++] = t;
  }
  mSurface.faces.resize(kept);
}

}  // namespace pdc::detail
