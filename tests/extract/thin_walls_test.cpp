#include <gtest/gtest.h>

#include "pdc/extract/contour.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/sample/implicit/field_source.h"

namespace pdc {
namespace {

/// What the mesh is of a spherical shell about `center`; lengths are in voxels.
MeshReport reportOfShell(const Vec3d& center, double radius, double thickness) {
  const double side = radius + 3;
  const FieldSource source(shell(sphere(center, radius), thickness),
                           {.box = {{-side, -side, -side}, {side, side, side}}, .voxelSize = 1});
  return analyze(contour(source));
}

TEST(ThinWalls, AreWholeFromTheRootOfTwoVoxels) {
  for (const double radius : {6.0, 10.3, 25.0})
    for (const Vec3d& center : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0.5}, Vec3d{0.13, 0.37, 0.71}, Vec3d{0.25, 0.5, 0},
                                Vec3d{0.9, 0.2, 0.44}, Vec3d{0.31, 0.62, 0.05}})
      for (const double thickness : {1.45, 1.7, 2.0, 2.5}) {
        const MeshReport report = reportOfShell(center, radius, thickness);
        EXPECT_EQ(report.components, 2u) << radius << " " << thickness;
        EXPECT_EQ(report.eulerNumber, 4) << radius << " " << thickness;
      }
}

TEST(ThinWalls, HaveHolesBelow) {
  EXPECT_NE(reportOfShell({0.13, 0.37, 0.71}, 25, 1.2).eulerNumber, 4);
  EXPECT_NE(reportOfShell({0.13, 0.37, 0.71}, 25, 0.8).eulerNumber, 4);
}

}  // namespace
}  // namespace pdc
