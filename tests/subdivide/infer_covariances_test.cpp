#include "pdc/subdivide/infer_covariances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pdc/error.h"
#include "pdc/math/solvers.h"
#include "subdivide/control_meshes.h"

namespace pdc {
namespace {

using namespace test;

double largestDifference(const Buffer<SymMat3<double>>& a, const std::vector<Eigen::Matrix3d>& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, (toEigen(a[v]) - b[v]).norm() / b[v].norm());
  return most;
}

TEST(InferCovariances, FacesMatchAnotherEvaluation) {
  for (const Mesh& mesh : {octahedron(), fan(5, false), mixedFaces(), quadCube()})
    EXPECT_LT(largestDifference(inferCovariances(mesh), naiveFaceCovariances(pointsOf(mesh), facesOf(mesh), 0.05)),
              1e-12);
}

TEST(InferCovariances, VerticesAreThoseOfTheRing) {
  const Mesh mesh = fan(5, false);
  const double bias = 0.25;
  const auto inferred = inferCovariances(mesh, {.source = CovarianceSource::kVertices, .absoluteBias = bias});
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : pointsOf(mesh)) mean += p / 6;
  Eigen::Matrix3d covariance = bias * Eigen::Matrix3d::Identity();
  for (const Eigen::Vector3d& p : pointsOf(mesh)) covariance += (p - mean) * (p - mean).transpose() / 6;
  EXPECT_LT((toEigen(inferred[0]) - covariance).norm(), 1e-12) << "all vertices are neighbours of the middle";
}

TEST(InferCovariances, NormalsAreThoseOfPlaneQuadrics) {
  Mesh mesh = octahedron();
  const auto of = [&] { return inferCovariances(mesh, {.source = CovarianceSource::kNormals, .sigmaNormal = 0.2}); };
  // About a corner of the octahedron faces are symmetric, so its normal is its direction.
  const SymMat3<double> expected{1 / 1.04, 0, 0, 1 / 0.04, 0, 1 / 0.04};
  EXPECT_LT((toEigen(of()[0]) - toEigen(expected)).norm(), 1e-10);
  mesh.normals.assign(6, Vec3f{0, 0, 3});
  const SymMat3<double> given{1 / 0.04, 0, 0, 1 / 0.04, 0, 1 / 1.04};
  EXPECT_LT((toEigen(of()[0]) - toEigen(given)).norm(), 1e-10) << "the mesh's own normals come first";
}

TEST(InferCovariances, EquilateralFacesAreTwentyOneToOne) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const Eigen3 eigen = eigenSymmetric(inferCovariances(mesh)[0]);
  EXPECT_NEAR(eigen.value[0] / eigen.value[2], 21, 1e-9);
  EXPECT_NEAR(eigen.value[0] / eigen.value[1], 1, 1e-9);
  EXPECT_NEAR(std::abs(dot(eigen.vector[2], {1, 1, 1})), std::sqrt(3), 1e-9);
}

TEST(InferCovariances, FollowTheUnitOfLength) {
  Mesh mesh = mixedFaces();
  for (const auto source : {CovarianceSource::kFaces, CovarianceSource::kVertices}) {
    const auto before = inferCovariances(mesh, {.source = source});
    Mesh large = mesh;
    for (Vec3f& p : large.positions) p *= 1024;
    const auto after = inferCovariances(large, {.source = source});
    for (std::size_t v = 0; v < before.size(); ++v) EXPECT_EQ(after[v], before[v] * (1024.0 * 1024.0));
  }
}

TEST(InferCovariances, RefusesFacesWithoutExtent) {
  Mesh mesh = octahedron();
  mesh.positions[0] = mesh.positions[2] = mesh.positions[4];
  try {
    (void)inferCovariances(mesh);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "face 0 has no covariance: its corners lie in one place, or the bias is less than 1e-12 of its largest "
              "eigenvalue");
  }
  EXPECT_NO_THROW((void)inferCovariances(mesh, {.absoluteBias = 1e-3}));
  EXPECT_THROW((void)inferCovariances(octahedron(), {.bias = 1e-14}), Error);
}

}  // namespace
}  // namespace pdc
