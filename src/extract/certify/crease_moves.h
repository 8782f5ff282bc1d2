#pragma once

#include <functional>
#include <vector>

#include "extract/certify/near_faces.h"

namespace pdc::detail {

/// Another place for a suspect vertex.
struct CreaseMove {
  std::size_t suspect;  ///< Its number among the suspect ones.
  Vec3f place;          ///< In lattice units from the centre of its cell.
};

/// Looks for single vertices on creases whose moving rids faces of conflicts, at little cost to the crease: tries
/// places along it first, which cost it nothing; then such on one of the sides that meet there, which cost flat parts
/// nothing; then such on the way to the safe place. Of those with the fewest conflicts left it takes the first. Each
/// vertex moves a few times at most.
class CreaseMoves {
 public:
  /// \param tests and `suspect` must outlive this.
  CreaseMoves(const FaceTests& tests, const std::vector<SuspectVertex>& suspect)
      : mTests(tests), mSuspects(suspect), mMoves(suspect.size()), mFailedWith(suspect.size()) {}

  /// \param movable number of a vertex among the suspect ones if it may be moved, or -1.
  /// \returns moves of which no two share a conflict, by ascending number, to be carried out; none where the map is not
  /// affine. Runs in parallel.
  [[nodiscard]] std::vector<CreaseMove> find(const NearFaces& near, const std::vector<Conflict>& conflicts,
                                             const std::function<std::ptrdiff_t(std::uint32_t)>& movable);
  /// Looks for better places for vertices on creases that are not where they are wanted.
  /// \param vertices their numbers among the suspect ones. \param wanted by suspect vertex: where its quadric wants it.
  /// \returns by ascending number the places where their faces have no conflict if no other vertex moves, nearer to the
  /// planes of their creases than where they are; none where the map is not affine. Runs in parallel.
  [[nodiscard]] std::vector<CreaseMove> findBetter(const NearFaces& near, const std::vector<std::size_t>& vertices,
                                                   const std::vector<Vec3f>& wanted) const;

 private:
  const FaceTests& mTests;
  const std::vector<SuspectVertex>& mSuspects;
  std::vector<std::uint8_t> mMoves;  ///< By suspect vertex: how often it moved.
  /// By suspect vertex: of how many conflicts it last found no way out, or 0. While there are as many it does not try
  /// again.
  std::vector<std::size_t> mFailedWith;
};

}  // namespace pdc::detail
