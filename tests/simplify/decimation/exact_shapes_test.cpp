// Shapes that few triangles hold without error come out as those, and units, places and threads do not matter.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "parallel/with_threads.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/simplify/cluster.h"
#include "pdc/simplify/decimate.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc {
namespace {

using test::cube, test::plate, test::sphere, test::torus, test::sameBytes;

/// The largest distance of a corner of the square or cube [low, 1] from the nearest vertex.
double cornerError(const Mesh& mesh, int dimensions, double low) {
  double most = 0;
  for (int i = 0; i < 1 << dimensions; ++i) {
    Vec3d corner{};
    for (int axis = 0; axis < dimensions; ++axis) corner[axis] = (i >> axis) % 2 == 0 ? low : 1;
    double nearest = 10;
    for (const Vec3f& p : mesh.positions) nearest = std::min(nearest, length(vecCast<double>(p) - corner));
    most = std::max(most, nearest);
  }
  return most;
}

// How many faces are merged must not matter.
TEST(ExactShapes, CubesOfAnySizeBecomeTwelveTriangles) {
  std::vector<int> sizes{9, 29, 91};
  if (std::getenv("PDC_LONG_TESTS") != nullptr) sizes.push_back(289);  // A million faces.
  for (const int n : sizes)
    for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kProbabilisticPlane}) {
      const Mesh fewer = decimate(cube(n), {.faces = 12, .quadric = kind});
      EXPECT_EQ(fewer.triangles.size(), 12u);
      EXPECT_EQ(fewer.positions.size(), 8u);
      EXPECT_LT(cornerError(fewer, 3, -1), 1e-6) << n;
    }
}

TEST(ExactShapes, SquaresBecomeTwoTriangles) {
  // With 27 and 34 the last edges that cost nothing wait beside each other.
  for (const int n : {10, 27, 34, 49, 65})
    for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kTriangle, QuadricKind::kProbabilisticPlane,
                                   QuadricKind::kProbabilisticTriangle}) {
      const Mesh fewer = decimate(plate(n), {.faces = 2, .quadric = kind});
      EXPECT_EQ(fewer.triangles.size(), 2u);
      EXPECT_LT(cornerError(fewer, 2, 0), 1e-4) << n;
    }
}

TEST(ExactShapes, SquaresThatDoNotTouchKeepTheirCorners) {
  Mesh many;
  const Mesh one = plate(20);
  constexpr std::uint32_t kCount = 30;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto first = static_cast<std::uint32_t>(many.positions.size());
    for (const Vec3f& p : one.positions) many.positions.push_back({p.x, p.y, static_cast<float>(i)});
    for (const auto& [a, b, c] : one.triangles) many.triangles.push_back({a + first, b + first, c + first});
  }
  for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kProbabilisticPlane}) {
    const Mesh fewer = decimate(many, {.faces = 2 * kCount, .quadric = kind});
    EXPECT_EQ(fewer.triangles.size(), 2 * kCount);
    EXPECT_NEAR(analyze(fewer).area, kCount, 1e-3);
  }
}

struct Case {
  const char* name;
  Mesh mesh;
  DecimateOptions options;
};

/// Meshes with creases, curvature, boundaries and noise, whose coordinates are multiples of 2^-12.
std::vector<Case> cases() {
  Mesh noisy = sphere(24);
  test::addNoise(noisy, 0.01);
  std::vector<Case> all{{"noise", noisy, {.ratio = 0.1}},
                        {"sound", noisy, {.ratio = 0.1, .sound = true}},
                        {"triangles", torus(40), {.ratio = 0.2, .quadric = QuadricKind::kProbabilisticTriangle}},
                        {"subset", torus(40), {.ratio = 0.2, .placement = CollapsePlacement::kSubset}},
                        {"cube", cube(20), {.faces = 100, .quadric = QuadricKind::kPlane, .memory = 1}},
                        {"boundary", plate(40), {.ratio = 0.1, .lockBoundary = true}}};
  for (Case& c : all)
    for (Vec3f& p : c.mesh.positions)
      for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] * 0x1p12F) * 0x1p-12F;
  return all;
}

TEST(ExactShapes, ThreadsDoNotMatter) {
  for (const Case& c : cases()) {
    const Mesh one = detail::withThreads(1, [&] { return decimate(c.mesh, c.options); });
    for (const int threads : {2, 3, 8}) {
      const Mesh many = detail::withThreads(threads, [&] { return decimate(c.mesh, c.options); });
      EXPECT_TRUE(sameBytes(one, many)) << c.name << ' ' << threads;
    }
  }
}

TEST(ExactShapes, PowersOfTwoScaleTheResult) {
  for (const Case& c : cases()) {
    const Mesh fewer = decimate(c.mesh, c.options), coarse = cluster(c.mesh, {.cell = 0.2});
    for (const float scale : {0x1p-10F, 0x1p10F}) {
      const auto scaled = [&](Mesh mesh) {
        for (Vec3f& p : mesh.positions) p *= scale;
        return mesh;
      };
      EXPECT_TRUE(sameBytes(decimate(scaled(c.mesh), c.options), scaled(fewer))) << c.name << ' ' << scale;
      EXPECT_TRUE(sameBytes(cluster(scaled(c.mesh), {.cell = double{scale} * 0.2}), scaled(coarse))) << c.name;
    }
  }
}

/// Other scales round the coordinates, and with that change which of two equal edges comes first.
TEST(ExactShapes, OtherScalesGiveAsGoodAResult) {
  for (const Case& c : cases()) {
    const Mesh fewer = decimate(c.mesh, c.options);
    for (const float scale : {1e-3F, 1e3F}) {
      Mesh scaled = c.mesh;
      for (Vec3f& p : scaled.positions) p *= scale;
      const Mesh other = decimate(scaled, c.options);
      EXPECT_EQ(other.triangles.size(), fewer.triangles.size()) << c.name;
      const double area = analyze(other).area / (double{scale} * scale);
      EXPECT_NEAR(area / analyze(fewer).area, 1, 2e-3) << c.name << ' ' << scale;
    }
  }
}

// All steps are taken from differences of coordinates, which are exact here.
TEST(ExactShapes, MovedMeshesGiveTheMovedResult) {
  const Vec3f by{1024, -512, 256};
  for (const Case& c : cases()) {
    Mesh moved = c.mesh;
    for (Vec3f& p : moved.positions) p += by;
    DecimateOptions options = c.options;
    options.sound = false;  // It decides on rounded coordinates, which are others there.
    const Mesh fewer = decimate(c.mesh, options), movedFewer = decimate(moved, options);
    ASSERT_EQ(fewer.triangles, movedFewer.triangles) << c.name;
    for (std::size_t v = 0; v < fewer.positions.size(); ++v)
      EXPECT_LE(largestEntry(vecCast<double>(fewer.positions[v]) + vecCast<double>(by) -
                             vecCast<double>(movedFewer.positions[v])),
                0x1p-14 + 1e-7)
          << c.name << ": half a step of single precision at 1024, and what was rounded before";
  }
}

}  // namespace
}  // namespace pdc
