#include "eval/locality.h"

#include <gtest/gtest.h>

#include <random>

#include "extract/certify/uncertified_mesh.h"
#include "pdc/extract/contour.h"
#include "pdc/field/noise.h"

namespace pdc {
namespace {

/// Boxes about random blocks come out as in the whole. \returns how many faces were compared.
std::size_t expectLocal(const HermiteSource& source, int boxes) {
  const SurfaceBlocks blocks = source.surfaceBlocks({});
  ContourReport report;
  const Mesh whole = contour(source, {}, &report);
  EXPECT_GT(report.outOfCell, 20U) << "there must be something to decide";
  std::mt19937 random(61);
  std::uniform_int_distribution<std::size_t> any(0, blocks.coords.size() - 1);
  std::uniform_int_distribution<int> size(0, 2);
  std::size_t faces = 0;
  for (int i = 0; i < boxes; ++i) {
    eval::BlockBox box{blocks.coords[any(random)], {}};
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = box.lo[axis] + size(random);
    const eval::FaceDifference d = eval::compareWithPart(source, blocks, whole, box);
    EXPECT_EQ(d.different, 0U);
    faces += d.faces;
  }
  return faces;
}

TEST(Locality, PartsOfACreasedSolidAreThoseOfTheWhole) { EXPECT_GT(expectLocal(detail::creasedSolid(100), 10), 500U); }

TEST(Locality, PartsOfRoughSurfacesAreThoseOfTheWhole) {
  const FieldPtr rough = subtract({sphere({}, 0.9), simplexNoise({.frequency = 5})});
  const FieldSource source(rough, {.box = {{-1, -1, -1}, {1, 1, 1}}, .voxelSize = 2.0 / 64});
  EXPECT_GT(expectLocal(source, 8), 1000U);
}

}  // namespace
}  // namespace pdc
