#pragma once

#include "mesh/triangle_tree.h"
#include "mesh/winding/solid_angles.h"

namespace pdc::detail {

/// The generalised winding number of a mesh (Jacobson, Kavan & Sorkine-Hornung 2013). That of a closed mesh is a whole
/// number and exact, as lattice_line.h has it; that of an open one is exact to about 0.003. Several threads may ask at
/// a time.
class WindingNumber {
 public:
  /// \param surface has to live as long.
  explicit WindingNumber(const ClosedSurface& surface);

  /// \param p relative to the mesh's origin, finite.
  [[nodiscard]] double at(const Vec3d& p) const { return whole(p) - mCaps.at(p); }
  /// The surface's own part, which changes evenly away from its triangles; that of closed meshes is empty.
  [[nodiscard]] const SolidAngles& caps() const { return mCaps; }

  [[nodiscard]] static bool isInside(double winding) { return winding > 0.5 || winding < -0.5; }

 private:
  [[nodiscard]] int whole(const Vec3d& p) const;

  const ClosedSurface& mSurface;
  TriangleTree mTree;
  SolidAngles mCaps;
  BoxF mBox;
};

}  // namespace pdc::detail
