#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"
#include "simplify/decimation/new_intersections.h"
#include "simplify/edge_collapse.h"
#include "simplify/error_bound/error_bound.h"
#include "simplify/error_bound/error_limits.h"
#include "simplify/error_bound/tracked_error.h"
#include "simplify/vertex_properties.h"
#include "simplify/vertex_quadrics.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// How it is to be done.
struct DecimationRule {
  std::size_t targetFaces;
  std::optional<ErrorLimits> error;  ///< See ErrorBound.
  QuadricRule quadrics;
  double memory;
  bool sigmaNormalOfVertices, memoryOfVertices;  ///< What is known of a vertex's noise chooses, where it is known.
  bool subset;
  double leastCosine;  ///< See CollapseChecks.
  bool sound;          ///< Whether no face may come to intersect another.

  [[nodiscard]] bool mayRefuse() const { return sound || error; }
};

/// Collapses edges of a surface in rounds of such as do not touch each other.
class Decimation {
 public:
  /// \param given the surface as it is now. All must outlive this.
  Decimation(DecimatedSurface& surface, const GivenSurface& given, InterpolatedProperties& properties,
             const DecimationRule& rule);

  /// Until there are no more faces than wanted, or none may be collapsed. \throws Cancelled.
  void run(const Monitor& monitor);

  /// By vertex given, that into which it was collapsed, or itself.
  [[nodiscard]] std::vector<std::uint32_t> takeBecame() { return std::move(mBecame); }
  [[nodiscard]] std::size_t rounds() const { return mRounds; }
  [[nodiscard]] std::size_t collapses() const { return mCollapses; }
  [[nodiscard]] std::size_t limitedMoves() const { return mLimitedMoves; }
  /// Collapses that would have made faces intersect, and such as would have gone too far from the surface given.
  [[nodiscard]] std::size_t intersectionRefusals() const { return mIntersectionRefusals; }
  [[nodiscard]] std::size_t errorRefusals() const { return mErrorRefusals; }

 private:
  /// An edge that may be collapsed: the corner at its lower end that runs towards the other.
  struct Candidate {
    float cost;
    std::uint32_t hash;  ///< Decides among equal costs: flat parts have nothing else.
    std::uint32_t a, b;
    friend bool operator<(const Candidate& x, const Candidate& y) {
      return x.cost != y.cost   ? x.cost < y.cost
             : x.hash != y.hash ? x.hash < y.hash
             : x.a != y.a       ? x.a < y.a
                                : x.b < y.b;
    }
  };

  struct Candidates {
    std::vector<Candidate> list;
    bool all;  ///< Whether there are no others.
  };

  void look();
  [[nodiscard]] NoiseChoice noiseOf(std::uint32_t vertex) const;
  void remember();
  void findCosts();
  void findCostsOf(std::uint32_t begin, std::uint32_t end, const Buffer<float>& before);
  [[nodiscard]] float costAlone(std::uint32_t corner) const;
  [[nodiscard]] std::array<std::uint32_t, 2> edgeAt(std::uint32_t corner) const;
  [[nodiscard]] float costOfCheapest(std::size_t count) const;
  [[nodiscard]] Candidates cheapest(std::size_t count) const;
  [[nodiscard]] EdgeCollapse collapseOf(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::vector<ChosenCollapse> choose(const std::vector<Candidate>& candidates);
  [[nodiscard]] bool lookCloser(const Monitor& monitor);
  void takeOutRefused(std::vector<ChosenCollapse>& chosen, const Monitor& monitor);
  void apply(const std::vector<ChosenCollapse>& chosen);
  void removeVanished();
  std::size_t refuse(const std::vector<ChosenCollapse>& collapses);
  /// Whether the faces about a vertex are others than in the round before, as far as that is known.
  [[nodiscard]] bool hasChanged(std::uint32_t vertex) const {
    return mChanged.empty() || mChanged[vertex] + 1 == mRounds;
  }
  [[nodiscard]] std::size_t facesAt(std::uint32_t a, std::uint32_t b) const;

  DecimatedSurface& mSurface;
  const GivenSurface& mGiven;
  InterpolatedProperties& mProperties;
  const DecimationRule mRule;
  const bool mRemembers;  ///< Whether the faces given have a share in the quadrics.
  VertexStars mStars;
  Buffer<FaceArea> mAreas;
  Buffer<VertexQuadric> mQuadrics;
  std::vector<Quadric<double>> mAccumulated;
  /// By corner: of the edge that leaves the vertex there; infinite if it is another's, or was refused.
  Buffer<float> mCosts, mCostsBefore;
  std::vector<std::uint32_t> mTouched;  ///< By vertex, the round in which a chosen collapse last touched it.
  std::vector<std::uint32_t> mChanged;  ///< By vertex, the round in which one was done; only where any may be refused.
  std::vector<std::uint32_t> mFirstCost;  ///< By vertex, where its costs of the round before begin; likewise.
  std::vector<std::uint32_t> mBecame;
  CollapseRule mCollapse;
  std::optional<TrackedError> mTracked;  ///< At first, where there is a bound on the error; then mBound.
  std::optional<ErrorBound> mBound;
  std::optional<NewIntersections> mIntersections;  ///< Where the surface has to be sound.
  std::size_t mRounds = 0, mCollapses = 0, mLimitedMoves = 0, mIntersectionRefusals = 0, mErrorRefusals = 0;
};

}  // namespace pdc::detail
