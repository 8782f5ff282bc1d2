#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "extract/conflicts/conflict.h"
#include "extract/conflicts/face_boxes.h"
#include "extract/conflicts/face_tests.h"
#include "extract/conflicts/round_progress.h"
#include "extract/topology/edge_set.h"
#include "pdc/math/simd_level.h"

namespace pdc::detail {

/// Finds the conflicts of faces, among all faces near them. All functions run in parallel and throw Cancelled.
class NearFaces {
 public:
  /// \param faces and `progress` must outlive this. \param level changes no result.
  NearFaces(const FaceTests& faces, RoundProgress& progress, SimdLevel level = bestSimdLevel())
      : mFaces(faces), mProgress(progress), mLevel(level), mBoxes(faces) {}

  /// The conflicts of the triangles of `active` against each other and against all others near them; sorted. A face of
  /// which a triangle is degenerate or faces backwards has that conflict, and is not searched for further ones. Counts
  /// as a round of the progress.
  /// \param active sorted; all faces that changed since the last call are among them.
  [[nodiscard]] std::vector<Conflict> findConflicts(const std::vector<EdgeRef>& active);

  /// For each of some edges whose faces are quads: whether there is no conflict if its quad is `turned[i]` instead,
  /// which has the same corners. No face has changed since the last findConflicts. \param edges sorted.
  [[nodiscard]] std::vector<std::uint8_t> soundWhenTurned(const std::vector<EdgeRef>& edges,
                                                          const std::vector<Quad>& turned);

  /// Where faces are, ready to be searched about all of these vertices.
  [[nodiscard]] const FaceBoxes& boxesAbout(const std::vector<VertexState>& vertices,
                                            std::span<const std::size_t> numbers);

 private:
  struct TestedFace;
  struct OtherQuad;

  void load(TestedFace& face, const EdgeRef& e) const;
  void search(TestedFace& face, const FaceBoxes::About& near, const EdgeSet* foundFrom,
              std::vector<Conflict>& out) const;
  static void compare(const TestedFace& face, const OtherQuad& other, std::vector<Conflict>& out);

  const FaceTests& mFaces;
  RoundProgress& mProgress;
  const SimdLevel mLevel;
  FaceBoxes mBoxes;
};

}  // namespace pdc::detail
