#pragma once

#include <cstdint>
#include <optional>
#include <span>
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

  /// Takes out collapses, which do not touch each other, that would break the bound, each alone. Runs in parallel; the
  /// result does not depend on the number of threads. \returns those taken out. \throws Cancelled.
  [[nodiscard]] std::vector<ChosenCollapse> takeOutFar(const VertexStars& stars, std::vector<ChosenCollapse>& collapses,
                                                       const Monitor& monitor);
  /// Takes out those that would break the bound if all were done, and makes ready for the others. \param collapses such
  /// as were not taken out before, in that order. \returns those taken out.
  [[nodiscard]] std::vector<ChosenCollapse> join(const VertexStars& stars, std::vector<ChosenCollapse>& collapses);
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
  /// For some triangles given the faces left that together are near to all of each.
  struct Coverings {
    struct Triangle {
      std::uint32_t number, begin, end;  ///< Of its faces, which are in a list of all.
    };
    std::vector<Triangle> triangles;
    Faces faces;

    [[nodiscard]] std::span<const std::uint32_t> of(const Triangle& t) const {
      return {faces.data() + t.begin, faces.data() + t.end};
    }
  };
  struct Change {
    ChosenCollapse collapse;
    std::uint32_t below;  ///< The triangle given that is nearest to the vertex.
    Coverings covered;
  };
  class NearFaces;

  void findLinks(const Monitor& monitor);
  [[nodiscard]] std::optional<Change> changeOf(const VertexStars& stars, const ChosenCollapse& collapse,
                                               const Monitor& monitor) const;
  [[nodiscard]] bool join(const VertexStars& stars, const Change& change);
  void setJoined(const Coverings& coverings);
  [[nodiscard]] Faces changedFaces(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] NearFaces newFaces(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] std::vector<std::uint32_t> trianglesAt(const Faces& faces) const;
  void facesOf(std::uint32_t triangle, Faces& faces) const;
  [[nodiscard]] bool areNear(const NearFaces& faces, const Faces& changed, std::uint32_t below) const;
  [[nodiscard]] bool cover(std::uint32_t triangle, std::span<const std::uint32_t> before, const Faces& changed,
                           NearFaces& faces, Coverings& out) const;
  void link(std::uint32_t triangle, std::span<const std::uint32_t> faces);
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
  Coverings mJoined;                                          ///< What they make of the faces of triangles given.
  std::vector<std::uint32_t> mJoinedAt;                       ///< By triangle given, where it is there, or kNone.
};

}  // namespace pdc::detail
