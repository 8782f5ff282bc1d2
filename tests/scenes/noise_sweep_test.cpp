#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "folders.h"
#include "pdc/extract/contour.h"
#include "pdc/field/operators.h"
#include "pdc/field/primitives.h"
#include "pdc/io/scene/scene_reader.h"
#include "pdc/sample/implicit/field_source.h"

// Figure 3 of Trettner & Kobbelt 2020: fractal simplex noise with a sphere cut out, at σn = 0, 0.10, 0.25 and infinity.
namespace pdc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Row {
  double sigma;
  double vertexRms;  ///< Vertices to the true surface, voxels.
  double creaseRms;  ///< Points of the true crease to the nearest vertex-pair edge of the mesh, voxels.
  double outOfCell;  ///< Share of vertices whose minimiser left the cell.
};

class NoiseSweep : public testing::Test {
 protected:
  NoiseSweep() : mScene(readScene(test::sourceFolder() / "scenes/noise_minus_sphere.yaml")), mVoxel(mScene.voxelSize) {}

  [[nodiscard]] Mesh mesh(double sigma, ContourReport* report = nullptr) const {
    const FieldSource source(mScene.field, {.box = mScene.box, .voxelSize = mVoxel});
    return contour(source, {.sigmaNormal = sigma, .placement = Placement::kFree, .triangles = true}, report);
  }

  /// First-order distance to the scene's surface, voxels.
  [[nodiscard]] double distance(const Vec3f& p) const {
    const Vec3d x = vecCast<double>(p);
    return std::abs(mScene.field->valueAt(x)) / length(mScene.field->gradientAt(x)) / mVoxel;
  }

  Scene mScene;
  double mVoxel;
};

/// The scene's crease: where the ball that is cut out meets the noise. Found by walking the ball's surface.
std::vector<Vec3d> creasePoints(const Scene& scene) {
  const Vec3d center{0.5, 0.75, 0.4};
  const double radius = 0.55;
  std::vector<Vec3d> points;
  constexpr int kMeridians = 400, kSteps = 2000;
  const auto at = [&](double theta, double phi, double r) {
    return center + Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)} * r;
  };
  // Just within the cut the scene is outside; just beyond it the scene is the noise alone.
  const auto noise = [&](double theta, double phi) {
    return scene.field->valueAt(at(theta, phi, radius * (1 + 1e-9)));
  };
  for (int m = 0; m < kMeridians; ++m) {
    const double phi = 2 * 3.14159265358979 * m / kMeridians;
    for (int k = 0; k < kSteps; ++k) {
      double a = 3.14159265358979 * k / kSteps, b = 3.14159265358979 * (k + 1) / kSteps;
      const double fa = noise(a, phi), fb = noise(b, phi);
      // On the ball's surface within the noise the scene's value is zero to rounding.
      const auto solid = [](double f) { return f < 1e-7; };
      if (solid(fa) == solid(fb)) continue;
      for (int i = 0; i < 50; ++i) {
        const double c = 0.5 * (a + b);
        (solid(noise(c, phi)) == solid(fa) ? a : b) = c;
      }
      points.push_back(at(a, phi, radius));
    }
  }
  return points;
}

double segmentDistance(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return length(p - a - d * t);
}

/// Distance from p to the edges of the mesh: a crease that is kept runs along edges.
double edgeDistance(const Vec3d& p, const Mesh& mesh, double reach) {
  double best = kInfinity;
  for (const Triangle& t : mesh.triangles) {
    if (length(vecCast<double>(mesh.positions[t[0]]) - p) > reach) continue;
    for (int i = 0; i < 3; ++i)
      best = std::min(best, segmentDistance(p, vecCast<double>(mesh.positions[t[i]]),
                                            vecCast<double>(mesh.positions[t[(i + 1) % 3]])));
  }
  return best;
}

TEST_F(NoiseSweep, GoesTheWayThePaperSays) {
  std::vector<Vec3d> crease = creasePoints(mScene);
  ASSERT_GT(crease.size(), 300u);
  std::vector<Row> rows;
  for (const double sigma : {0.0, 0.10, 0.25, kInfinity}) {
    ContourReport report;
    const Mesh m = mesh(sigma, &report);
    double vertices = 0, creases = 0;
    for (const Vec3f& p : m.positions) vertices += std::pow(distance(p), 2);
    for (const Vec3d& p : crease) creases += std::pow(edgeDistance(p, m, 4 * mVoxel) / mVoxel, 2);
    rows.push_back({sigma, std::sqrt(vertices / static_cast<double>(m.positions.size())),
                    std::sqrt(creases / static_cast<double>(crease.size())),
                    static_cast<double>(report.outOfCell) / static_cast<double>(m.positions.size())});
  }
  std::printf("%8s %22s %18s %12s\n", "sigma_n", "vertex RMS (voxel)", "crease RMS (voxel)", "out of cell");
  for (const Row& r : rows)
    std::printf("%8g %22.5f %18.5f %11.3f%%\n", r.sigma, r.vertexRms, r.creaseRms, 100 * r.outOfCell);
  // "The best of the two worlds" in between: less spiky than the classical quadric, sharper than the mass point.
  const Row &none = rows[0], &low = rows[1], &medium = rows[2], &all = rows[3];
  for (const Row& between : {low, medium}) {
    EXPECT_LT(between.vertexRms, none.vertexRms);
    EXPECT_LT(between.vertexRms, all.vertexRms);
    EXPECT_LT(between.creaseRms, 0.5 * all.creaseRms);
  }
  EXPECT_LT(low.creaseRms, 1.1 * none.creaseRms);
  EXPECT_LT(low.creaseRms, medium.creaseRms);
  // Spikes are minimisers that leave their cells.
  EXPECT_GT(none.outOfCell, low.outOfCell);
  EXPECT_GT(low.outOfCell, medium.outOfCell);
  EXPECT_EQ(all.outOfCell, 0);
}

TEST_F(NoiseSweep, TheLimitIsTheMassPoint) {
  const Mesh infinite = mesh(kInfinity), large = mesh(1e4);
  ASSERT_EQ(infinite.positions.size(), large.positions.size());
  for (std::size_t i = 0; i < infinite.positions.size(); ++i)
    ASSERT_LT(length(infinite.positions[i] - large.positions[i]) / mVoxel, 1e-5);
}

}  // namespace
}  // namespace pdc
