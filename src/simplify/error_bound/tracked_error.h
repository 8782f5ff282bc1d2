#pragma once

#include <vector>

#include "simplify/decimated_surface.h"
#include "simplify/edge_collapse.h"
#include "simplify/error_bound/error_limits.h"
#include "simplify/vertex_stars.h"

namespace pdc::detail {

/// Keeps a decimated surface and the one given within limits of each other, all points of either, by adding up how far
/// collapses move faces: more than they are apart, but nothing of the surface given has to be looked at.
class TrackedError {
 public:
  /// \param surface nothing of it has been collapsed yet; it has to live as long. \param limits of its faces.
  TrackedError(const DecimatedSurface& surface, const ErrorLimits& limits);

  /// Takes out collapses, which do not touch each other, that may break the bound. Runs in parallel.
  /// \returns those taken out.
  [[nodiscard]] std::vector<ChosenCollapse> takeOutFar(const VertexStars& stars,
                                                       std::vector<ChosenCollapse>& collapses) const;
  /// Some collapses are going to be done that were not taken out. \pre No face has another number yet.
  void accept(const VertexStars& stars, const std::vector<ChosenCollapse>& collapses);
  /// Tells that a face has another number from now on; lower numbers come first.
  void renumber(std::uint32_t face, std::uint32_t number) {
    mErrors[number] = mErrors[face];
    if (!mLimits.empty()) mLimits[number] = mLimits[face];
  }

 private:
  [[nodiscard]] double limitOf(const VertexStars& stars, const ChosenCollapse& collapse) const;
  [[nodiscard]] double errorOf(const VertexStars& stars, const ChosenCollapse& collapse, double limit) const;

  const DecimatedSurface& mSurface;
  const double mDistance;
  std::vector<double> mErrors;  ///< By face: how far its points are at most from those given that they stand for.
  std::vector<double> mLimits;  ///< By face: how far they may be. Empty if that is the distance for all.
};

}  // namespace pdc::detail
