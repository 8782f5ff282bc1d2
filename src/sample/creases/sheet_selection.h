#pragma once

#include <array>
#include <span>

#include "pdc/math/mat3.h"
#include "sample/cell_edges.h"
#include "sample/creases/crease_sheets.h"

namespace pdc::detail {

/// A corner of a cell, from its centre, in lattice units.
constexpr Vec3d cornerFromCenter(int corner) { return cornerPlace(corner) - Vec3d{0.5, 0.5, 0.5}; }

/// σn of sheets, which are made of many samples. \param noise of the distances, in voxels.
[[nodiscard]] float sheetSigma(double noise);

/// The crossings of a patch.
struct PatchCrossings {
  struct Edge {
    int inside, outside;  ///< Corners of the cell, x + 2y + 4z.
    double t;             ///< Where it crosses zero, from inside.
  };
  std::array<Edge, 12> edge;
  int count = 0;
  Vec3d massPoint{};  ///< The mean of the crossings, from the cell's centre, in world space, in voxels.
};

/// Tells which sheets near a cell are those of a patch.
class SheetSelection {
 public:
  /// \param M from lattice steps to world space, in voxels. \param noise of the distances, in voxels.
  SheetSelection(const Mat3d& M, double noise);

  /// Leaves the sheets that a patch's crossings lie on and those that meet them within the cell; of these only such as
  /// have a point in common with the others. \param sheets from the cell's centre, at least one. \returns the point
  /// where those that are left meet.
  Vec3d select(const PatchCrossings& crossings, CreaseSheets& sheets) const;

  /// Where sheets meet, nearest to the mean of the crossings.
  [[nodiscard]] Vec3d meeting(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const;
  /// How far crossings are from the sheet that is nearest to each, RMS, in voxels.
  [[nodiscard]] double crossingError(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const;
  /// The sheet that is nearest to all crossings.
  [[nodiscard]] int nearest(const PatchCrossings& crossings, std::span<const CreaseSheet> sheets) const;

 private:
  static constexpr int kCorners = 8;
  using AtCorners = std::array<double, kCorners>;
  using Flags = std::array<bool, CreaseSheets::kMax>;

  void keepCrossedOrMeeting(const PatchCrossings& crossings, CreaseSheets& sheets) const;
  [[nodiscard]] Flags crossedSheets(const PatchCrossings& crossings, const CreaseSheets& sheets) const;
  void valueAtCorners(const CreaseSheet& sheet, AtCorners& value) const;

  Mat3d mInverse;
  double mNoise;
  alignas(64) AtCorners mX, mY, mZ;  ///< The cell's corners, from its centre, in world space, in voxels.
};

}  // namespace pdc::detail
