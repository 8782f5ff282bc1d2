#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "extract/edge_set.h"
#include "extract/face_tests.h"
#include "pdc/math/simd_level.h"

namespace pdc::detail {

/// Two triangles that meet where they should not; or, twice the same, one that is degenerate or faces backwards.
struct Offence {
  EdgeRef edge0, edge1;  ///< Whose faces they belong to.
  Triangle triangle0, triangle1;
  friend auto operator<=>(const Offence&, const Offence&) = default;
};

/// Calls visit for each corner of an offence's triangles.
template <typename Visit>
void forEachCorner(const Offence& o, Visit&& visit) {
  for (const Triangle& t : {o.triangle0, o.triangle1})
    for (const std::uint32_t v : t) visit(v);
}

/// Finds what faces meet, among all faces near them.
class NearFaces {
 public:
  /// \param farReaching the edges whose faces may leave the cells about them; sorted.
  NearFaces(const FaceTests& tests, const std::vector<EdgeRef>& farReaching);

  /// The offences of the triangles of `active`, which is sorted, against each other and against all others near them;
  /// sorted. Runs in parallel.
  [[nodiscard]] std::vector<Offence> findOffences(const std::vector<EdgeRef>& active) const;

  struct Face {
    EdgeRef edge;
    std::uint64_t number;
  };
  /// The faces that may reach into a box of lattice space.
  [[nodiscard]] std::vector<Face> facesAbout(const Vec3d& low, const Vec3d& high) const;
  /// Whether facesAbout and findOffences still find the edge's face everywhere if a corner of it lies there. For affine
  /// maps.
  [[nodiscard]] bool finds(const EdgeRef& e, const Vec3f& corner) const;
  /// Where a corner is in lattice space; for affine maps.
  [[nodiscard]] Vec3d latticePosition(const Vec3f& corner) const;

  /// For each of some edges whose faces are quads: whether there is no offence if its quad is `turned[i]` instead,
  /// which has the same corners. Runs in parallel.
  [[nodiscard]] std::vector<std::uint8_t> soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                          const std::vector<Quad>& turned) const;

 private:
  struct Scratch;

  [[nodiscard]] double reachOf(const EdgeRef& e) const;
  /// Of a corner from a lattice point, along the axis where it is largest, in lattice units.
  [[nodiscard]] double distance(const Coord& at, const Vec3f& corner) const;
  [[nodiscard]] std::pair<Vec3d, Vec3d> latticeBox(const EdgeRef& e, const Scratch& own) const;
  template <typename Visit>
  void forEachNear(const Vec3d& low, const Vec3d& high, Visit&& visit) const;
  template <typename Visit>
  bool forEachIn(std::int32_t block, const Vec3d& low, const Vec3d& high, Visit& visit) const;
  /// Appends the offences of the face in `own`.
  /// \param foundFrom offences of a face of these that comes before are left to it. Null: one offence is enough.
  void search(const EdgeRef& e, Scratch& own, const EdgeSet* foundFrom, std::vector<Offence>& out) const;
  void compare(const EdgeRef& e, const Scratch& own, std::size_t i, const EdgeRef& other, const Triangle& t,
               const TriangleCorners& corners, std::vector<Offence>& out) const;

  const FaceTests& mTests;
  const SimdLevel mLevel = bestSimdLevel();
  const Mat3d mToLattice;
  const Vec3d mOrigin;
  const EdgeSet mFar;  ///< The far-reaching faces.
  /// By block that has some: how far they reach from the low ends of their edges along an axis, in lattice units.
  std::vector<double> mReach;
  double mLargestReach;
};

}  // namespace pdc::detail
