#include "pdc/mesh/vertex_covariances.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "pdc/error.h"

namespace pdc {
namespace {

Mesh threeVertices() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return mesh;
}

std::string complaint(const std::vector<SymMat3<double>>& covariances, CovarianceKind kind) {
  Mesh mesh = threeVertices();
  setVertexCovariances(mesh, covariances);
  try {
    (void)vertexCovariances(mesh, kind);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

constexpr SymMat3<double> kOne = SymMat3<double>::identity();

TEST(VertexCovariances, ComeBackAsTheyWereGiven) {
  Mesh mesh = threeVertices();
  mesh.properties = {{"height", 1, Buffer<float>{1, 2, 3}}};
  EXPECT_FALSE(hasVertexCovariances(mesh));
  const std::vector<SymMat3<double>> given{kOne, {4, 1, 0.5, 3, 0.25, 2}, kOne * 1e-30};
  setVertexCovariances(mesh, given);
  setVertexCovariances(mesh, given);
  EXPECT_TRUE(hasVertexCovariances(mesh));
  EXPECT_EQ(mesh.properties.size(), 7u);
  const auto read = vertexCovariances(mesh, CovarianceKind::kDefinite);
  EXPECT_EQ(std::vector(read.begin(), read.end()), given);
  EXPECT_EQ(mesh.values<double>("covyz")[1], 0.25);
  EXPECT_THROW(setVertexCovariances(mesh, std::vector{kOne}), std::invalid_argument);
}

TEST(VertexCovariances, SingularOnesAreSemidefinite) {
  const std::vector<SymMat3<double>> flat{kOne, kOne, {1, 0, 0, 1, 0, 0}};
  EXPECT_EQ(complaint(flat, CovarianceKind::kSemidefinite), "");
  EXPECT_NE(complaint(flat, CovarianceKind::kDefinite).find("vertex 2 has the eigenvalues 0 and 1"), std::string::npos);
  const std::vector<SymMat3<double>> rounded{kOne, {1, 0, 0, 1, 0, -1e-7}, kOne};
  EXPECT_EQ(complaint(rounded, CovarianceKind::kSemidefinite), "");
  EXPECT_NE(complaint(rounded, CovarianceKind::kDefinite).find("vertex 1 has the eigenvalue -1e-07; the limit is 0"),
            std::string::npos);
}

TEST(VertexCovariances, OthersAreRefusedByVertex) {
  for (const auto kind : {CovarianceKind::kSemidefinite, CovarianceKind::kDefinite}) {
    EXPECT_EQ(complaint({kOne, {1, 2, 0, 1, 0, 1}, kOne}, kind),
              "the covariance of vertex 1 has the eigenvalue -1; the limit is 0");
    EXPECT_EQ(complaint({kOne, kOne, {1, 0, 0, std::numeric_limits<double>::infinity(), 0, 1}}, kind),
              "the covariance of vertex 2 is not finite");
  }
}

TEST(VertexCovariances, MissingEntriesAreNamed) {
  Mesh mesh = threeVertices();
  EXPECT_THROW((void)vertexCovariances(mesh, CovarianceKind::kDefinite), Error);
  setVertexCovariances(mesh, std::vector<SymMat3<double>>(3, kOne));
  mesh.properties[4].name = "covzy";
  try {
    (void)vertexCovariances(mesh, CovarianceKind::kDefinite);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "the vertices have no property 'covyz'");
  }
}

TEST(VertexCovariances, ReportCountsThem) {
  Mesh mesh = threeVertices();
  setVertexCovariances(mesh, std::vector<SymMat3<double>>{kOne * 3.0, {1, 0, 0, 1, 0, -0.5}, kOne * 0.25});
  const CovarianceReport report = analyzeCovariances(mesh);
  EXPECT_EQ(report.definite, 2u);
  EXPECT_EQ(report.firstOther, 1u);
  EXPECT_DOUBLE_EQ(report.leastEigenvalue, -0.5);
  EXPECT_DOUBLE_EQ(report.largestEigenvalue, 3);
}

}  // namespace
}  // namespace pdc
