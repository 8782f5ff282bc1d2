#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "pdc/math/vec3.h"

namespace pdc::eval {

/// A triangle; a segment has its second corner twice.
struct Piece {
  Vec3d a, b, c;
};

/// Distances to the nearest of many small pieces.
class Nearest {
 public:
  /// \param reach distances beyond it are not told apart.
  explicit Nearest(double reach) : mReach(reach) {}

  void add(const Piece& piece);
  /// \returns the distance to the nearest piece, at most `reach`.
  [[nodiscard]] double distance(const Vec3d& p) const;

 private:
  static std::uint64_t key(int x, int y, int z);

  double mReach;
  std::vector<Piece> mPieces;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> mCells;  ///< Edge: mReach.
};

}  // namespace pdc::eval
