#include "smooth/vertex_sigmas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <string>

#include "folders.h"
#include "pdc/io/mesh/mesh_reader.h"
#include "pdc/smooth/smooth.h"
#include "simplify/same_bytes.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

using test::cube, test::plate, test::sphere, test::torus;

/// The side of a cone of height 2 with radii 1 and `top`, in 2 n m triangles; of a cylinder for 1.
Mesh cone(int n, int m, double top) {
  Mesh mesh;
  for (int k = 0; k <= m; ++k)
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, radius = 1 - (1 - top) * k / m;
      mesh.positions.push_back(vecCast<float>(Vec3d{radius * std::cos(angle), radius * std::sin(angle), 2.0 * k / m}));
    }
  const auto at = [n](int i, int k) { return static_cast<std::uint32_t>(k * n + i % n); };
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

std::vector<double> sigmasOf(const SmoothedSurface& surface) {
  const Monitor monitor;
  BlockProgress progress(monitor, "", 1);
  return measuredSigmas(surface, progress);
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

TEST(VertexSigmas, CleanShapesHaveNone) {
  for (const Mesh& mesh : {cube(2), cube(3), cube(16), sphere(12), torus(24), plate(10), cone(32, 10, 1),
                           cone(32, 10, 0.5), cone(32, 10, 0.001)}) {
    EXPECT_EQ(largest(sigmasOf(SmoothedSurface(mesh))), 0) << mesh.positions.size();
    EXPECT_TRUE(test::sameBytes(smooth(mesh, {}), mesh));
  }
}

TEST(VertexSigmas, TheFanDiskHasNone) {
  const std::filesystem::path path = test::dataFolder() / "mesh/fandisk_13k.off";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Mesh mesh = readMesh(path);
  EXPECT_EQ(largest(sigmasOf(SmoothedSurface(mesh))), 0);
}

TEST(VertexSigmas, NoiseIsFoundToAFifth) {
  for (const Mesh& clean : {cube(24), sphere(24), torus(36), plate(40)})
    for (const double noise : {0.1, 0.2}) {
      Mesh mesh = clean;
      test::addNoise(mesh, noise * SmoothedSurface(clean).frame().unit());
      const SmoothedSurface surface(mesh);
      // The noise makes edges longer, too.
      const double unit = surface.frame().unit() / SmoothedSurface(clean).frame().unit();
      EXPECT_NEAR(mean(sigmasOf(surface)) * unit, noise, 0.2 * noise) << clean.positions.size();
    }
}

TEST(VertexSigmas, NoiseIsFoundWhereItIs) {
  const Mesh clean = cube(24);
  Mesh mesh = clean;
  test::addNoise(mesh, 0.01);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (clean.positions[v].x < 0) mesh.positions[v] = clean.positions[v];
  const std::vector<double> sigmas = sigmasOf(SmoothedSurface(mesh));
  double least = 1, count = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    // Three edges, of a twelfth each, are as far as anything is looked at.
    if (clean.positions[v].x < -0.26F) {
      EXPECT_EQ(sigmas[v], 0) << v;
    }
    if (clean.positions[v].x > 0.26F) {
      least = std::min(least, sigmas[v]);
      count += sigmas[v] > 0.06;
    }
  }
  EXPECT_GT(count, 1000);
  EXPECT_GT(least, 0.03);
}

TEST(VertexSigmas, ASpikeDoesNotJudgeItself) {
  Mesh mesh = plate(20);
  mesh.positions[210].z = 0.2F;
  EXPECT_EQ(largest(sigmasOf(SmoothedSurface(mesh))), 0);
}

TEST(VertexSigmas, FansOfManyTrianglesTakeNoTime) {
  // In the tests' time limit only if no neighbour of the hub looks at all of its triangles.
  constexpr std::uint32_t kRim = 50'000;
  Mesh mesh;
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 0; i < kRim; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRim;
    mesh.positions.push_back(vecCast<float>(Vec3d{1e4 * std::cos(angle), 1e4 * std::sin(angle), 0}));
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kRim});
  }
  EXPECT_EQ(sigmasOf(SmoothedSurface(mesh)).size(), kRim + 1);
}

}  // namespace
}  // namespace pdc::detail
