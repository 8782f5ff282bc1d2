#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle_forest.h"
#include "pdc/monitor.h"
#include "simplify/decimated_surface.h"
#include "simplify/decimation/intersecting_faces.h"
#include "simplify/edge_collapse.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Keeps faces of a decimated surface from intersecting that did not before, nor did those that they come from. Decided
/// exactly, on positions as the result will have them.
class NewIntersections {
 public:
  /// \param surface nothing of it has been collapsed yet; it has to live as long. Runs in parallel. \throws Cancelled.
  NewIntersections(const DecimatedSurface& surface, const Monitor& monitor);

  /// Takes out collapses, which do not touch each other, so that any of those that stay may be done. Runs in parallel;
  /// the result does not depend on the number of threads.
  /// \returns those that are not possible beside the faces there are. Others that are taken out only have to wait: they
  /// are in the way of one that stays, or of faces that another one changes. \throws Cancelled.
  [[nodiscard]] std::vector<ChosenCollapse> takeOut(const VertexStars& stars, std::vector<ChosenCollapse>& collapses,
                                                    const Monitor& monitor);
  /// Some collapses that stayed are going to be done. \pre No face has another number yet.
  void accept(const VertexStars& stars, const std::vector<ChosenCollapse>& collapses);
  /// Tells that a face has another number from now on; lower numbers come first.
  void renumber(std::uint32_t face, std::uint32_t number) { mGiven[number] = mGiven[face]; }

 private:
  enum class Answer : std::uint8_t { kPossible, kWaits, kImpossible };
  struct Change;
  class NewFaces;

  [[nodiscard]] Change changeOf(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] std::vector<Change> changesOf(const VertexStars& stars, const std::vector<ChosenCollapse>& all) const;
  [[nodiscard]] Answer answerTo(const Change& change) const;
  [[nodiscard]] bool intersect(std::uint32_t face, std::uint32_t other) const;
  [[nodiscard]] bool haveMet(const Change& change, std::uint32_t face) const;
  [[nodiscard]] bool haveMet(const Change& a, const Change& b) const;
  void replaceMet(const Buffer<std::uint32_t>& changed);

  const DecimatedSurface& mSurface;
  Mesh mMesh;                            ///< The faces by the number that they were given with, in world space.
  std::vector<std::uint32_t> mGiven;     ///< By the number that a face has now, the one it was given with.
  std::vector<std::uint32_t> mChanging;  ///< By number given, the last search in which a collapse was to change it.
  std::uint32_t mSearches = 0;
  TriangleForest mForest;  ///< Those left that have an area.
  FacePairs mMet;          ///< Faces that intersect, by number given; each pair both ways round, sorted.
};

}  // namespace pdc::detail
