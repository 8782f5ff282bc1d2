#pragma once

#include <functional>
#include <vector>

#include "extract/certify/near_faces.h"

namespace pdc::detail {

/// Another place for a loose vertex.
struct CreaseMove {
  std::size_t loose;  ///< Its number among the loose ones.
  Vec3f place;        ///< In lattice units from the centre of its cell.
};

/// Looks for single vertices on creases whose moving rids faces of offences, at little cost to the crease: tries places
/// along it first, which cost it nothing; then such on one of the sides that meet there, which cost flat parts nothing;
/// then such on the way to the safe place. Of those with the fewest offences left it takes the first. Each vertex moves
/// a few times at most.
class CreaseMoves {
 public:
  /// \param tests and `loose` must outlive this.
  CreaseMoves(const FaceTests& tests, const std::vector<LooseVertex>& loose)
      : mTests(tests), mLoose(loose), mMoves(loose.size()), mFailedWith(loose.size()) {}

  /// \param movable number of a vertex among the loose ones if it may be moved, or -1.
  /// \returns moves of which no two share an offence, by ascending number, to be carried out; none where the map is not
  /// affine. Runs in parallel.
  [[nodiscard]] std::vector<CreaseMove> find(const NearFaces& near, const std::vector<Offence>& offences,
                                             const std::function<std::ptrdiff_t(std::uint32_t)>& movable);
  /// Looks for better places for vertices on creases that are not where they are wanted.
  /// \param vertices their numbers among the loose ones. \param wanted by loose vertex: where its quadric wants it.
  /// \returns by ascending number the places where their faces have no offence if no other vertex moves, nearer to the
  /// planes of their creases than where they are; none where the map is not affine. Runs in parallel.
  [[nodiscard]] std::vector<CreaseMove> findBetter(const NearFaces& near, const std::vector<std::size_t>& vertices,
                                                   const std::vector<Vec3f>& wanted) const;

 private:
  const FaceTests& mTests;
  const std::vector<LooseVertex>& mLoose;
  std::vector<std::uint8_t> mMoves;  ///< By loose vertex: how often it moved.
  /// By loose vertex: of how many offences it last found no way out, or 0. While there are as many it does not try
  /// again.
  std::vector<std::size_t> mFailedWith;
};

}  // namespace pdc::detail
