#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh/winding/solid_angles.h"
#include "pdc/sample/hermite_source.h"
#include "sample/mesh/lattice_crossings.h"

namespace pdc::detail {

/// Which lattice points are inside a mesh, and where edges cross its surface. Lives as long as the surface and lattice
/// that it is made of.
class MeshSolid {
 public:
  MeshSolid(const ClosedSurface& surface, const MeshLattice& lattice, const Monitor& monitor);

  /// All blocks with surface, sorted. Reports the stage "sample".
  [[nodiscard]] SurfaceBlocks surfaceBlocks(const Monitor& monitor) const;

  struct Crossing {
    float t;
    Vec3f normal;
  };
  /// Where an edge whose ends lie on different sides is crossed. \param insideAtLow whether its lower end is inside.
  [[nodiscard]] Crossing crossing(Axis axis, const Coord& point, bool insideAtLow) const;

 private:
  [[nodiscard]] std::vector<Coord> blocksWithTriangles() const;
  /// \returns whether there is surface in the block.
  bool readSigns(const Coord& block, BlockSigns& signs) const;
  [[nodiscard]] Box boxOf(const Coord& low, int size) const;
  /// As if the caps belonged to the mesh.
  void readWhole(const Coord& block, BlockSigns& signs) const;
  /// Takes the caps away where they may matter.
  void subtractCaps(const Coord& block, BlockSigns& signs) const;
  [[nodiscard]] double windingAt(const Coord& point) const;
  [[nodiscard]] const EdgeCrossing* deciding(std::span<const EdgeCrossing> own, Axis axis, const Coord& point,
                                             bool insideAtLow) const;
  [[nodiscard]] Crossing holeCrossing(Axis axis, const Coord& point) const;
  [[nodiscard]] Vec3f normalOf(std::uint32_t triangle) const;

  const ClosedSurface& mSurface;
  MeshLattice mLattice;
  std::array<LatticeCrossings, 3> mCrossings;  ///< By axis; those along z with the caps.
  LatticeWinding mWinding;                     ///< Of the closed surface.
  SolidAngles mCaps;
};

}  // namespace pdc::detail
