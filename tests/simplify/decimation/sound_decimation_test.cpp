// Contours that lie near themselves stay sound where that is asked for.

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "pdc/extract/contour.h"
#include "pdc/field/noise.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "pdc/sample/implicit/field_source.h"
#include "pdc/simplify/decimate.h"

namespace pdc {
namespace {

struct Solid {
  std::string name;
  FieldPtr field;
};

std::vector<Solid> solids() {
  const FieldPtr ball = sphere({0, 0, 0}, 0.9);
  return {{"noise", intersect({simplexNoise({.octaves = 3, .frequency = 1.5}), ball})},
          {"thin sheets", intersect({gyroid(0.9, 0.1), ball})},
          {"a shell", subtract({ball, sphere({0, 0, 0.02}, 0.86)})},
          {"a thin plate", box({0.01, 0.02, 0.03}, {0.8, 0.7, 0.035})},
          {"spheres that nearly touch", unite({sphere({-0.43, 0, 0}, 0.4), sphere({0.43, 0.02, 0}, 0.4)})},
          {"a drilled block", subtract({box({0, 0, 0}, {0.8, 0.7, 0.6}), cylinder({-1, 0, 0}, {1, 0.1, 0}, 0.5),
                                        cylinder({0, -1, 0}, {0.1, 1, 0}, 0.5)})}};
}

TEST(SoundDecimation, NoFacesIntersectAtAnyShare) {
  std::size_t withoutSound = 0;
  for (const Solid& solid : solids()) {
    const FieldSource source(solid.field, {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 1.0 / 13});
    const Mesh mesh = contour(source, {.triangles = true});
    ASSERT_TRUE(selfIntersections(mesh).pairs.empty()) << solid.name;
    for (const double share : {0.3, 0.05, 0.01}) {
      const Mesh sound = decimate(mesh, {.ratio = share, .sound = true});
      const SelfIntersections found = selfIntersections(sound);
      EXPECT_EQ(found.pairs.size() + found.degenerateTriangles, 0u) << solid.name << ' ' << share;
      const MeshReport report = analyze(sound);
      EXPECT_EQ(report.boundaryEdges + report.nonManifoldEdges + report.nonManifoldVertices, 0u) << solid.name;
      EXPECT_EQ(report.eulerNumber, analyze(mesh).eulerNumber) << solid.name;
      EXPECT_LT(sound.triangles.size(), mesh.triangles.size() / 2) << solid.name;
      withoutSound += selfIntersections(decimate(mesh, {.ratio = share})).pairs.size();
    }
  }
  EXPECT_GT(withoutSound, 20u) << "or the test shows nothing";
}

}  // namespace
}  // namespace pdc
