#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/edge_collapse.h"
#include "simplify/pair_contraction/linked_faces.h"
#include "simplify/pair_contraction/star_checks.h"
#include "simplify/pair_contraction/vertex_pairs.h"
#include "simplify/vertex_properties.h"
#include "simplify/vertex_quadrics.h"

namespace pdc::detail {

/// How it is to be done; lengths are in mean edge lengths.
struct PairContractionRule {
  std::size_t targetFaces;
  QuadricRule quadrics;
  double distance;  ///< Pairs that no edge joins are closer.
  bool subset;      ///< See CollapsePlacement.
  double leastCosine;
  bool lockBoundary;
};

/// The most pairs that are looked at, per vertex: those within some eleven edge lengths on an even surface.
inline constexpr std::size_t kMostPairs = 256;

/// Makes pairs of vertices one, those of an edge and those close to each other (Garland & Heckbert 1997), the cheapest
/// first. Runs on the calling thread but for the costs at the beginning; the result does not depend on threads.
class PairContraction {
 public:
  /// \param positions finite where faces name them, which do not name a vertex twice. Both hold the result after run().
  PairContraction(std::vector<Vec3d>& positions, Buffer<Triangle>& faces, InterpolatedProperties& properties,
                  const PairContractionRule& rule);

  /// Until there are no more faces than wanted, or no pair may be contracted. To be called once. \throws Error for too
  /// many pairs; Cancelled.
  void run(const Monitor& monitor);

  [[nodiscard]] std::size_t contractions() const { return mContractions; }
  /// How many of them were of pairs that no edge joined.
  [[nodiscard]] std::size_t merges() const { return mMerges; }
  [[nodiscard]] std::size_t limitedMoves() const { return mLimitedMoves; }
  /// Faces left out because others had, or came to have, the same vertices.
  [[nodiscard]] std::size_t duplicates() const { return mDuplicates; }

 private:
  struct Candidate {
    float cost;
    std::uint32_t hash, pair;
    friend bool operator>(const Candidate& x, const Candidate& y) {
      return x.cost != y.cost ? x.cost > y.cost : x.hash != y.hash ? x.hash > y.hash : x.pair > y.pair;
    }
  };
  /// What making one of two vertices comes to.
  struct Trial {
    std::uint32_t a, b;
    bool isEdge;
    float cost;
    EdgeCollapse to;
  };

  void findQuadrics();
  [[nodiscard]] VertexQuadric quadricOf(std::uint32_t vertex, std::span<const StarCorner> star,
                                        const Buffer<FaceArea>& areas) const;
  void lockBoundary(std::uint32_t vertex, std::span<const StarCorner> star);
  void findPairs(const Monitor& monitor);
  void fillQueue();
  [[nodiscard]] std::optional<Trial> tryPair(std::uint32_t pair) const;
  [[nodiscard]] Candidate candidateOf(std::uint32_t pair, const Trial& trial) const;
  void enqueue(std::uint32_t pair);
  void push(const Candidate& candidate);
  [[nodiscard]] Candidate pop();
  [[nodiscard]] bool isAllowed(const Trial& trial);
  void contract(const Trial& trial);
  void removeFacesBetween(const Trial& trial);
  void addFace(const Triangle& t, double sign);
  void addFaces(std::span<const StarCorner> star, double sign);
  void forget(std::vector<std::uint32_t> vertices);
  void enqueueAround(std::uint32_t vertex);

  std::vector<Vec3d>& mPositions;
  Buffer<Triangle>& mGiven;
  InterpolatedProperties& mProperties;
  const PairContractionRule mRule;
  std::size_t mDuplicates;  ///< Before the faces that are linked, which are those without duplicates.
  LinkedFaces mFaces;
  VertexPairs mPairs;
  std::vector<std::uint8_t> mLocked,
      mRefused;  ///< By vertex; the latter, whether one of its pairs waits outside the queue.
  Buffer<VertexQuadric> mQuadrics;
  CollapseRule mCollapse;
  VertexMarks mMarks;
  ManifoldStars mManifolds;
  std::vector<Candidate> mQueue;  ///< A heap.
  // The stars of the pair that is looked at, and whether both of its ends and what becomes of them are manifold.
  std::vector<StarCorner> mStarA, mStarB;
  bool mStaysManifold = false;
  std::size_t mContractions = 0, mMerges = 0, mLimitedMoves = 0;
};

}  // namespace pdc::detail
