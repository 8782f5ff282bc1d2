#include "pdc/points/reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/mesh/distance.h"
#include "pdc/mesh/mesh_report.h"
#include "pdc/mesh/self_intersections.h"
#include "points/point_shapes.h"
#include "simplify/same_bytes.h"

namespace pdc {
namespace {

TEST(Reconstruct, IsCloserToASphereThanItsPoints) {
  constexpr double kNoise = 0.01;
  ReconstructReport report;
  Mesh covarianceMesh;
  const Mesh mesh = reconstruct(test::noisySphere(30000, kNoise), {}, &report, &covarianceMesh);
  double sum = 0;
  for (const Vec3f& p : mesh.positions) sum += std::pow(length(vecCast<double>(p)) - 1, 2);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(mesh.positions.size())), 0.4 * kNoise);
  EXPECT_LT(report.gaussians, 30000U / 6);
  EXPECT_EQ(report.controlTriangles, covarianceMesh.triangles.size());
  EXPECT_EQ(mesh.triangles.size(), 4 * covarianceMesh.triangles.size());
  EXPECT_EQ(report.triangulation.components, 1U);
}

TEST(Reconstruct, DependsNeitherOnThreadsNorOnTheOrderOfThePoints) {
  PointCloud cloud = test::noisySphere(6000, 0.01);
  const Mesh one = detail::withThreads(1, [&] { return reconstruct(cloud); });
  EXPECT_TRUE(test::sameBytes(one, detail::withThreads(3, [&] { return reconstruct(cloud); })));
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), std::mt19937_64(2));
  EXPECT_TRUE(test::sameBytes(one, reconstruct(cloud)));
}

TEST(Reconstruct, ContoursAClosedSurfaceWithoutSelfIntersections) {
  // Half a sphere: what is open is closed first.
  PointCloud cloud = test::noisySphere(20000, 0.01);
  std::erase_if(cloud.positions, [](const Vec3d& p) { return p.z < 0; });
  const Mesh mesh = reconstruct(cloud, {.voxelSize = 0.05});
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.nonManifoldVertices + facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
  EXPECT_NEAR(facts.volume, 2.0944, 0.1);
  EXPECT_EQ(selfIntersections(mesh).pairs.size(), 0U);
}

/// Points on the faces of the cube from -1 to 1, turned so that no face lies along the lattice.
Vec3d turned(const Vec3d& p) {
  const Vec3d q{p.x * 0.8 - p.y * 0.6, p.x * 0.6 + p.y * 0.8, p.z};
  return {q.x, q.y * 0.96 - q.z * 0.28, q.y * 0.28 + q.z * 0.96};
}

PointCloud cubePoints(std::size_t n, double noise) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::normal_distribution<double> jitter(0, noise);
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const int axis = static_cast<int>(i % 3);
    Vec3d p{0, 0, 0};
    p[axis] = i % 2 == 0 ? -1 : 1;
    p[(axis + 1) % 3] = uniform(random);
    p[(axis + 2) % 3] = uniform(random);
    cloud.positions.push_back(turned(p) + Vec3d{jitter(random), jitter(random), jitter(random)});
  }
  return cloud;
}

TEST(Reconstruct, ContoursTheEdgesOfACubeSharplyWithoutNormals) {
  constexpr double kVoxel = 0.08;
  const Mesh mesh = reconstruct(cubePoints(15000, 0.004), {.voxelSize = kVoxel});
  const MeshReport facts = analyze(mesh);
  EXPECT_EQ(facts.boundaryEdges + facts.nonManifoldEdges + facts.nonManifoldVertices + facts.misorientedEdges, 0U);
  EXPECT_EQ(facts.eulerNumber, 2);
  EXPECT_EQ(selfIntersections(mesh).pairs.size(), 0U);
  std::vector<Vec3f> edges;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = -9; i <= 9; ++i) {
      for (const double a : {-1.0, 1.0}) {
        for (const double b : {-1.0, 1.0}) {
          Vec3d p{0, 0, 0};
          p[axis] = 0.1 * i;
          p[(axis + 1) % 3] = a;
          p[(axis + 2) % 3] = b;
          edges.push_back(vecCast<float>(turned(p)));
        }
      }
    }
  }
  double sum = 0;
  for (const double d : distances(edges, mesh)) sum += d * d;
  EXPECT_LT(std::sqrt(sum / static_cast<double>(edges.size())), 0.15 * kVoxel);
}

TEST(Reconstruct, ContoursTheSameForAnyNumberOfThreadsAndOrderOfThePoints) {
  PointCloud cloud = test::noisySphere(6000, 0.01);
  const ReconstructOptions options{.voxelSize = 0.1};
  const Mesh one = detail::withThreads(1, [&] { return reconstruct(cloud, options); });
  EXPECT_TRUE(test::sameBytes(one, detail::withThreads(3, [&] { return reconstruct(cloud, options); })));
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), std::mt19937_64(2));
  EXPECT_TRUE(test::sameBytes(one, reconstruct(cloud, options)));
}

TEST(Reconstruct, SaysThatPointsOnAPlaneEncloseNothing) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> jitter(0, 0.003);
  PointCloud flat, noisy;
  for (int i = 0; i < 5000; ++i) {
    flat.positions.push_back({uniform(random), uniform(random), 2});
    noisy.positions.push_back(flat.positions.back() + Vec3d{0, 0, jitter(random)});
  }
  for (const PointCloud& cloud : {flat, noisy}) {
    try {
      (void)reconstruct(cloud, {.voxelSize = 0.02});
      ADD_FAILURE() << "a plane has no inside";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("enclose nothing"), std::string::npos);
    }
  }
}

TEST(Reconstruct, SaysThatPointsMakeNoSurface) {
  PointCloud line;
  for (int i = 0; i < 100; ++i) line.positions.push_back({0.1 * i, 0, 0});
  try {
    (void)reconstruct(line);
    FAIL() << "a line has no surface";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no surface"), std::string::npos);
  }
}

TEST(Reconstruct, MakesAPlaneOfPointsOnAPlane) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  PointCloud cloud;
  for (int i = 0; i < 5000; ++i) cloud.positions.push_back({uniform(random), uniform(random), 2});
  const Mesh mesh = reconstruct(cloud);
  for (const Vec3f& p : mesh.positions) EXPECT_EQ(p.z, 2);
  EXPECT_NEAR(analyze(mesh).area, 1, 0.1);
}

}  // namespace
}  // namespace pdc
