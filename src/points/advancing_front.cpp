#include "points/advancing_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parallel/for_each_in_parallel.h"

namespace pdc::detail {
namespace {

constexpr double kFlat = 2 * std::numbers::pi / 3;
constexpr double kLeastSine = 0.0523;  ///< Of the angles of a triangle: 3°.
/// Twice the standard deviation: triangles that lie closer above each other are the same sheet.
constexpr double kSheetDeviations = 2;

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// The sine of the smallest angle of a triangle, by its normal and sides.
bool isSliver(const Vec3d& normal, const Vec3d& p, const Vec3d& q, const Vec3d& r) {
  const std::array sides{length(q - p), length(r - q), length(p - r)};
  const auto [shortest, longest] = std::minmax({sides[0], sides[1], sides[2]});
  const double middle = sides[0] + sides[1] + sides[2] - shortest - longest;
  return !(length(normal) > kLeastSine * middle * longest);
}

/// The angle between two triangles that share an edge and are turned the same way: π where they are flat.
double dihedral(const Vec3d& n, const Vec3d& m) {
  const double cosine = dot(n, m) / std::sqrt(dot(n, n) * dot(m, m));
  return std::numbers::pi - std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Calls visit(k, BC_ak, BC_bk) for the common neighbours, ascending.
template <typename Visit>
void visitCommon(std::span<const Overlaps::Neighbour> a, std::span<const Overlaps::Neighbour> b, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].index < b[j].index) {
      ++i;
    } else if (b[j].index < a[i].index) {
      ++j;
    } else {
      visit(a[i].index, a[i].coefficient, b[j].coefficient);
      ++i, ++j;
    }
  }
}

}  // namespace

AdvancingFront::AdvancingFront(const GaussianMixture& mixture, const Overlaps& overlaps, double leastDihedral,
                               GrowingSurface& surface)
    : mMixture(mixture), mOverlaps(overlaps), mLeastDihedral(leastDihedral), mSurface(surface) {}

double AdvancingFront::probability(std::uint32_t a, std::uint32_t b, std::uint32_t k) const {
  return mOverlaps.coefficient(a, b) * mOverlaps.coefficient(b, k) * mOverlaps.coefficient(a, k);
}

/// Equation 22 for the triangle (b, a, k), and 1 more where it is flat; nothing if it must not be added.
std::optional<double> AdvancingFront::grade(std::uint32_t a, std::uint32_t b, std::uint32_t k,
                                            double probability) const {
  if (mSurface.isInside(k) || !mSurface.accepts({b, a, k})) return std::nullopt;
  const Vec3d n = mSurface.normal(b, a, k);
  if (isSliver(n, mSurface.place(a), mSurface.place(b), mSurface.place(k))) return std::nullopt;
  double beta = std::numbers::pi;
  const std::array<std::array<std::uint32_t, 2>, 3> beyond{{{a, b}, {k, a}, {b, k}}};
  for (const auto& [from, to] : beyond) {
    const std::uint32_t third = mSurface.across(from, to);
    if (third != GrowingSurface::kNone) beta = std::min(beta, dihedral(n, mSurface.normal(from, to, third)));
  }
  if (beta <= mLeastDihedral) return std::nullopt;
  // What goes on flatly comes before all that bends, or a fold could lead to the other side of the surface.
  const double first = beta >= kFlat ? 1 : 0;
  return first + probability * beta / std::numbers::pi;
}

std::optional<AdvancingFront::Candidate> AdvancingFront::best(std::uint32_t a, std::uint32_t b) const {
  const double ab = mOverlaps.coefficient(a, b);
  const auto refused = mRefused.find(edgeKey(a, b));
  std::optional<Candidate> found;
  visitCommon(mOverlaps.of(a), mOverlaps.of(b), [&](std::uint32_t k, double ak, double bk) {
    const double product = ab * bk * ak;  // In the order of probability(), so that both round alike.
    if (found && 1 + product < found->grade) return;
    if (refused != mRefused.end() && std::count(refused->second.begin(), refused->second.end(), k) > 0) return;
    const auto graded = grade(a, b, k, product);
    if (!graded) return;
    const Candidate candidate{*graded, a, b, k};
    if (!found || *found < candidate) found = candidate;
  });
  return found;
}

/// The most probable triangle of a and two others, where none of the three has a triangle.
std::optional<AdvancingFront::Candidate> AdvancingFront::bestSeed(std::uint32_t a) const {
  if (mSurface.isUsed(a)) return std::nullopt;
  std::vector<Overlaps::Neighbour> near;
  for (const Overlaps::Neighbour& neighbour : mOverlaps.of(a))
    if (!mSurface.isUsed(neighbour.index)) near.push_back(neighbour);
  std::sort(near.begin(), near.end(), [](const auto& p, const auto& q) {
    return p.coefficient != q.coefficient ? p.coefficient > q.coefficient : p.index < q.index;
  });
  std::optional<Candidate> found;
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      const double most = near[i].coefficient * near[j].coefficient;
      if (found && most <= found->grade) break;
      const Candidate candidate{most * mOverlaps.coefficient(near[i].index, near[j].index), a, near[i].index,
                                near[j].index};
      if (candidate.grade <= 0 || (found && !(*found < candidate))) continue;
      const Vec3d n = mSurface.normal(a, candidate.b, candidate.k);
      if (isSliver(n, mSurface.place(a), mSurface.place(candidate.b), mSurface.place(candidate.k))) continue;
      const auto refused = mRefused.find(edgeKey(a, candidate.b));
      if (refused != mRefused.end() && std::count(refused->second.begin(), refused->second.end(), candidate.k) > 0)
        continue;
      found = candidate;
    }
  }
  return found;
}

bool AdvancingFront::liesOnOthers(const Triangle& t) const {
  const std::array<Vec3d, 3> own{mSurface.place(t[0]), mSurface.place(t[1]), mSurface.place(t[2])};
  const Vec3d normal = mSurface.normal(t[0], t[1], t[2]);
  double variance = 0;
  for (const std::uint32_t v : t) variance = std::max(variance, quadraticForm(mMixture.covariances[v], normal));
  const double height = kSheetDeviations * std::sqrt(variance / dot(normal, normal));
  const auto covers = [&](std::uint32_t v) {
    for (const GrowingSurface::Corner& corner : mSurface.corners(v)) {
      const std::array<Vec3d, 3> other{mSurface.place(v), mSurface.place(corner.to), mSurface.place(corner.third)};
      if (coverEachOther(own, other, height)) return true;
    }
    return false;
  };
  for (const std::uint32_t v : t) {
    if (covers(v)) return true;
    for (const Overlaps::Neighbour& neighbour : mOverlaps.of(v))
      if (covers(neighbour.index)) return true;
  }
  return false;
}

void AdvancingFront::push(std::uint32_t a, std::uint32_t b) {
  if (!mSurface.isFront(a, b)) return;
  if (const auto candidate = best(a, b)) mQueue.push(*candidate);
}

void AdvancingFront::pushEdges(const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) push(t[k], t[(k + 1) % 3]);
}

void AdvancingFront::run(const Monitor& monitor) {
  for (std::size_t steps = 0; !mQueue.empty(); ++steps) {
    if (steps % 1024 == 0) monitor.throwIfStopped();
    const Candidate candidate = mQueue.top();
    const auto& [value, a, b, k] = candidate;
    mQueue.pop();
    if (!mSurface.isFront(a, b)) continue;
    const auto now = grade(a, b, k, probability(a, b, k));
    if (!now || *now < value) {
      if (!now && !mSurface.accepts({b, a, k})) ++mCounts.nonManifold;
      push(a, b);
      continue;
    }
    if (liesOnOthers({b, a, k})) {
      ++mCounts.overlapping;
      mRefused[edgeKey(a, b)].push_back(k);
      push(a, b);
      continue;
    }
    mSurface.add({b, a, k});
    pushEdges({b, a, k});
  }
}

void AdvancingFront::advance(const Monitor& monitor) {
  for (std::size_t i = 0; i < mSurface.triangles().size(); ++i) pushEdges(Triangle(mSurface.triangles()[i]));
  run(monitor);
}

void AdvancingFront::seed(const Monitor& monitor) {
  std::vector<std::optional<Candidate>> first(mMixture.size());
  forEachInParallel(first.size(), 64, [&](std::uint32_t i) { first[i] = bestSeed(i); });
  std::priority_queue<Candidate> seeds;
  for (const auto& candidate : first)
    if (candidate) seeds.push(*candidate);
  const std::size_t all = std::max<std::size_t>(1, seeds.size());
  while (!seeds.empty()) {
    monitor.throwIfStopped();
    const Candidate candidate = seeds.top();
    const auto& [value, a, b, k] = candidate;
    seeds.pop();
    if (mSurface.isUsed(a)) continue;
    const bool free = !mSurface.isUsed(b) && !mSurface.isUsed(k);
    const bool fits = free && !liesOnOthers({a, b, k});
    if (!fits) {
      if (free) mRefused[edgeKey(a, b)].push_back(k);
      if (const auto next = bestSeed(a)) seeds.push(*next);
      continue;
    }
    ++mCounts.seeds;
    mSurface.add({a, b, k});
    pushEdges({a, b, k});
    run(monitor);
    if (monitor.progress)
      monitor.progress("triangulate", 1 - static_cast<double>(seeds.size()) / static_cast<double>(all));
  }
}

}  // namespace pdc::detail
