#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"
#include "simplify/edge_collapse.h"
#include "simplify/error_bound/envelope.h"
#include "simplify/error_bound/error_limits.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Keeps a decimated surface and the one given within limits of each other, all points of either. Decided on positions
/// as the result will have them.
///
/// For the faces left that is asked of the surface given as it is. For each triangle given it is known which faces left
/// are near to it, all of them together to all of it; where one of them changes others are found.
class ErrorBound {
 public:
  /// \param given the faces given. \param surface within the limits of them; it has to live as long.
  /// \param limits of the faces given; they have to live as long. Runs in parallel. \throws Cancelled.
  ErrorBound(const Buffer<Triangle>& given, const DecimatedSurface& surface, const ErrorLimits& limits,
             const Monitor& monitor);

  /// Takes out collapses, which do not touch each other, that would break the bound if all of them were done, and makes
  /// ready for the others. Runs in parallel; the result does not depend on the number of threads.
  /// \returns those taken out. \throws Cancelled.
  [[nodiscard]] std::vector<ChosenCollapse> takeOutFar(const VertexStars& stars, std::vector<ChosenCollapse>& collapses,
                                                       const Monitor& monitor);
  /// What it is ready for is going to be done. \pre No face has another number yet.
  void accept(const VertexStars& stars);
  /// Tells that a face has another number from now on; lower numbers come first.
  void renumber(std::uint32_t face, std::uint32_t number) { mFaceGiven[number] = mFaceGiven[face]; }

 private:
  static constexpr std::uint32_t kNone = NearestTriangle::kNone;

  using Faces = std::vector<std::uint32_t>;
  /// That a triangle given and a face left, or parts of them, are near to each other.
  struct Link {
    std::uint32_t triangle;  ///< kNone if it does not count any more.
    std::uint32_t face;
    std::uint32_t nextOfTriangle, nextOfFace;
  };
  /// Faces left that together are near to all of a triangle given.
  struct Covered {
    std::uint32_t triangle;
    Faces faces;
  };
  struct Change {
    ChosenCollapse collapse;
    std::uint32_t below;  ///< The triangle given that is nearest to the vertex.
    std::vector<Covered> covered;
  };
  class NearFaces;

  void findLinks(const Monitor& monitor);
  [[nodiscard]] std::optional<Change> changeOf(const VertexStars& stars, const ChosenCollapse& collapse,
                                               const Monitor& monitor) const;
  [[nodiscard]] bool join(const VertexStars& stars, Change& change);
  [[nodiscard]] std::vector<ChosenCollapse> joinAll(const VertexStars& stars, std::vector<ChosenCollapse>& collapses);
  [[nodiscard]] Faces changedFaces(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] NearFaces newFaces(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] std::vector<std::uint32_t> trianglesAt(const Faces& faces) const;
  [[nodiscard]] Faces facesOf(std::uint32_t triangle) const;
  [[nodiscard]] bool areNear(const NearFaces& faces, const Faces& changed, std::uint32_t below) const;
  [[nodiscard]] bool cover(Covered& covered, const Faces& before, const Faces& changed, NearFaces& faces) const;
  void putInto(const ChosenCollapse& collapse, const Vec3f& a, const Vec3f& b);
  void link(const Covered& covered);
  void unlink(std::uint32_t triangle);
  [[nodiscard]] Vec3f placeOf(std::uint32_t vertex) const {
    return mSurface.written(vertex, mSurface.positions[vertex]);
  }
  [[nodiscard]] Vec3f placeOf(const ChosenCollapse& c) const { return mSurface.written(c.a, c.to.place); }

  const DecimatedSurface& mSurface;
  const ErrorLimits& mLimits;
  Mesh mGiven;
  Envelope mEnvelope;
  Buffer<Vec3f> mPlaces;              ///< By vertex, in world space, as if everything it is ready for was done.
  Buffer<Triangle> mFaces;            ///< Those left, by the number that they were given with.
  Faces mFaceGiven;                   ///< By the number that a face has now, the one it was given with.
  std::vector<std::uint32_t> mBelow;  ///< By vertex left, a triangle given that is near to it.
  std::vector<Link> mLinks;
  std::vector<std::uint32_t> mFree;                           ///< Links to be used again.
  std::vector<std::uint32_t> mFirstOfFace, mFirstOfTriangle;  ///< Links, the faces by number given.
  std::vector<Change> mChanges;                               ///< What it is ready for.
  std::unordered_map<std::uint32_t, Faces> mJoined;           ///< By triangle given, what they make of its faces.
};

}  // namespace pdc::detail
