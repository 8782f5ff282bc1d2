#pragma once

#include <cstddef>
#include <cstdint>

#include "extract/topology/suspect_vertex.h"

namespace pdc::detail {

/// A suspect vertex and what certifying has done with it so far.
struct VertexState : SuspectVertex {
  explicit VertexState(const SuspectVertex& v) : SuspectVertex(v), wanted(v.place), retractedFrom(v.place) {}

  Vec3f wanted;                  ///< Where its quadric wants it.
  Vec3f retractedFrom;           ///< The end, opposite to its safe place, of the way on which it is retracted.
  std::uint8_t retractions = 0;  ///< Steps taken on that way.
  std::uint8_t creaseMoves = 0;  ///< How often it was moved along its crease.
  /// How many conflicts its faces had when no better place along its crease was found, or 0. While there are as many
  /// the search is not repeated.
  std::size_t unresolvedConflicts = 0;
};

}  // namespace pdc::detail
