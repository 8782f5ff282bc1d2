#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "pdc/monitor.h"
#include "pdc/points/gaussian_mixture.h"
#include "points/growing_surface.h"
#include "points/overlaps.h"

namespace pdc::detail {

struct FrontCounts {
  std::size_t seeds = 0, nonManifold = 0, overlapping = 0;
};

/// Grows a surface over Gaussians greedily, triangle by triangle (Preiner et al. 2019, section 6.2).
class AdvancingFront {
 public:
  AdvancingFront(const GaussianMixture& mixture, const Overlaps& overlaps, double leastDihedral,
                 GrowingSurface& surface);

  /// Advances from what is on the surface's front already until no triangle can be added.
  void advance(const Monitor& monitor);
  /// Starts new surfaces where Gaussians are left, the best triangle first, and advances each.
  void seed(const Monitor& monitor);

  [[nodiscard]] const FrontCounts& counts() const { return mCounts; }

 private:
  /// A triangle (b, a, k) beyond the edge from a to b of the front, or, as a seed, any.
  struct Candidate {
    double grade;
    std::uint32_t a, b, k;

    friend bool operator<(const Candidate& p, const Candidate& q) {
      if (p.grade != q.grade) return p.grade < q.grade;
      return std::tie(p.a, p.b, p.k) > std::tie(q.a, q.b, q.k);
    }
  };

  [[nodiscard]] double probability(std::uint32_t a, std::uint32_t b, std::uint32_t k) const;
  [[nodiscard]] std::optional<double> grade(std::uint32_t a, std::uint32_t b, std::uint32_t k,
                                            double probability) const;
  [[nodiscard]] std::optional<Candidate> best(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::optional<Candidate> bestSeed(std::uint32_t a) const;
  [[nodiscard]] bool liesOnOthers(const Triangle& t) const;
  void push(std::uint32_t a, std::uint32_t b);
  void pushEdges(const Triangle& t);
  void run(const Monitor& monitor);

  const GaussianMixture& mMixture;
  const Overlaps& mOverlaps;
  double mLeastDihedral;
  GrowingSurface& mSurface;
  std::priority_queue<Candidate> mQueue;
  /// By edge: third corners of triangles that would lie on others.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> mRefused;
  FrontCounts mCounts;
};

}  // namespace pdc::detail
