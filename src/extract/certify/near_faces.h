#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "extract/certify/face_tests.h"
#include "extract/certify/triangle_filters.h"
#include "extract/topology/edge_set.h"
#include "pdc/math/simd_level.h"

namespace pdc::detail {

/// Two triangles that meet where they should not; or, twice the same, one that is degenerate or faces backwards.
struct Conflict {
  EdgeRef edge0, edge1;  ///< Whose faces they belong to.
  Triangle triangle0, triangle1;
  friend auto operator<=>(const Conflict&, const Conflict&) = default;
};

/// Calls visit for each corner of a conflict's triangles.
template <typename Visit>
void forEachCorner(const Conflict& o, Visit&& visit) {
  for (const Triangle& t : {o.triangle0, o.triangle1})
    for (const std::uint32_t v : t) visit(v);
}

/// Finds what faces meet, among all faces near them.
class NearFaces {
 public:
  /// \param farReaching the edges whose faces may leave the cells about them; sorted.
  NearFaces(const FaceTests& tests, const std::vector<EdgeRef>& farReaching);

  /// The conflicts of the triangles of `active` against each other and against all others near them; sorted. Runs in
  /// parallel.
  /// \param active sorted; all faces that changed since the last call are among them.
  [[nodiscard]] std::vector<Conflict> findConflicts(const std::vector<EdgeRef>& active);

  /// Replaces `out` by the edges whose faces may reach into a box of world space; for affine maps.
  void facesAbout(const Box& box, std::vector<EdgeRef>& out) const;
  /// How far, as distance() has it, corners of the edge's face may go from the low end of the edge so that facesAbout
  /// and findConflicts still find the face everywhere; negative if it is none of the far-reaching ones.
  [[nodiscard]] double farReach(const EdgeRef& e) const;
  /// From a lattice point to a place in lattice space, along the axis where it is largest.
  [[nodiscard]] static double distance(const Vec3d& from, const Vec3d& place);
  /// Where a corner is in lattice space; for affine maps.
  [[nodiscard]] Vec3d latticePosition(const Vec3f& corner) const;

  /// For each of some edges whose faces are quads: whether there is no conflict if its quad is `turned[i]` instead,
  /// which has the same corners. No face has changed since the last findConflicts. Runs in parallel.
  [[nodiscard]] std::vector<std::uint8_t> soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                          const std::vector<Quad>& turned) const;

 private:
  struct Scratch;
  struct LatticeBox {
    Vec3d low, high;
  };
  /// A far-reaching face, with those that may reach into a box of world space.
  struct FarFace {
    EdgeRef edge;
    Box now;                         ///< The box of the face itself.
    Box likely;                      ///< The box for which the lists hold: it will hardly ever leave it.
    std::vector<std::uint32_t> far;  ///< Numbers of far-reaching faces.
    std::vector<EdgeRef> others;
  };

  [[nodiscard]] double reachOf(const EdgeRef& e) const;
  [[nodiscard]] LatticeBox latticeBox(const EdgeRef& e, const Box& box) const;
  [[nodiscard]] LatticeBox latticeBox(const Box& box) const;
  void facesAbout(const LatticeBox& box, std::vector<EdgeRef>& out) const;
  void addFacesOf(std::int32_t block, const LatticeBox& box, std::vector<EdgeRef>& out) const;
  [[nodiscard]] bool staysApart(const EdgeRef& e, const Box& box) const;
  void updateBox(FarFace& face, Scratch& own) const;
  void list(FarFace& face, std::vector<EdgeRef>& edges) const;
  [[nodiscard]] const FarFace* listed(const EdgeRef& e) const;
  template <typename Visit>
  void forEachNear(const EdgeRef& e, Scratch& own, Visit&& visit) const;
  void load(Scratch& own, const std::vector<Triangle>& triangles) const;
  /// Appends the conflicts of the face in `own`.
  /// \param foundFrom conflicts of a face of these that comes before are left to it. Null: one conflict is enough.
  void search(const EdgeRef& e, Scratch& own, const EdgeSet* foundFrom, std::vector<Conflict>& out) const;
  void compare(const EdgeRef& e, const Scratch& own, const EdgeRef& other, const Quad& quad,
               const std::array<Vec3f, 4>& corners, std::vector<Conflict>& out) const;

  const FaceTests& mTests;
  const SimdLevel mLevel = bestSimdLevel();
  const Mat3d mToLattice;
  const Vec3d mOrigin;
  const EdgeSet mFar;  ///< The far-reaching faces.
  /// By block that has some: how far they reach from the low ends of their edges along an axis, in lattice units.
  std::vector<double> mReach;
  double mLargestReach;
  std::vector<FarFace> mFarFaces;  ///< By number in mFar; empty where they are too many to list.
};

}  // namespace pdc::detail
