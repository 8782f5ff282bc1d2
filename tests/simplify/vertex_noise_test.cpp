#include "simplify/vertex_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/mesh/distance.h"
#include "pdc/simplify/decimate.h"
#include "simplify/shapes.h"

namespace pdc::detail {
namespace {

using test::plate, test::sphere;

constexpr std::array<const char*, 6> kNames{"covxx", "covxy", "covxz", "covyy", "covyz", "covzz"};

Mesh withSigma(Mesh mesh, float sigma) {
  mesh.properties = {{"sigma", 1, Buffer<float>(mesh.positions.size(), sigma)}};
  return mesh;
}

/// Gives every vertex of a mesh one covariance.
Mesh withCovariance(Mesh mesh, const SymMat3<float>& c) {
  const std::array<float, 6> entries{c.xx, c.xy, c.xz, c.yy, c.yz, c.zz};
  for (std::size_t i = 0; i < entries.size(); ++i)
    mesh.properties.push_back({kNames[i], 1, Buffer<float>(mesh.positions.size(), entries[i])});
  return mesh;
}

std::string complaint(const Mesh& mesh, const std::string& property) {
  try {
    VertexNoise(mesh, property, 1);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(VertexNoise, CountsInMeanEdges) {
  const VertexNoise noise(withSigma(plate(2), 0.5F), "sigma", 2);
  EXPECT_TRUE(noise.known());
  EXPECT_DOUBLE_EQ(noise.mean(), 0.25);
  EXPECT_DOUBLE_EQ(noise.variance(0, {0, 0, 1}), 0.0625);
  EXPECT_FALSE(VertexNoise().known());
}

TEST(VertexNoise, FacesCountInInverseProportionToTheirVariance) {
  Mesh mesh = withSigma(plate(2), 0.1F);
  std::get<Buffer<float>>(mesh.properties[0].values) = {0, 0, 0, 0.1F, 0.1F, 0.1F, 0.2F, 0.2F, 0.2F};
  const VertexNoise noise(mesh, "sigma", 1);
  const Vec3d up{0, 0, 1};
  EXPECT_EQ(noise.trust({0, 1, 2}, up), 1);
  EXPECT_NEAR(noise.trust({3, 4, 5}, up) / noise.trust({6, 7, 8}, up), 4, 0.05);
  // The mean of 0, 0 and 0.04 is a third of that of three times 0.04.
  EXPECT_NEAR(noise.trust({0, 1, 6}, up) / noise.trust({6, 7, 8}, up), 3, 0.05);
  EXPECT_LT(noise.trust({3, 4, 5}, up), 0.02);
}

TEST(VertexNoise, CovariancesCountAlongTheNormal) {
  const Vec3d up{0, 0, 3}, aside{2, 0, 0}, between{1, 0, 1};
  const VertexNoise noise(withCovariance(plate(2), {0, 0, 0, 0, 0, 0.04F}), "cov", 1);
  EXPECT_NEAR(noise.variance(0, up), 0.04, 1e-8);
  EXPECT_EQ(noise.variance(0, aside), 0);
  EXPECT_NEAR(noise.variance(0, between), 0.02, 1e-8);
  EXPECT_EQ(noise.variance(0, {0, 0, 0}), 0);
  EXPECT_EQ(noise.trust({0, 1, 2}, aside), 1);
  const VertexNoise scalar(withSigma(plate(2), 0.2F), "sigma", 1);
  EXPECT_NEAR(noise.trust({0, 1, 2}, up), scalar.trust({0, 1, 2}, up), 1e-7);
  EXPECT_NEAR(VertexNoise(withCovariance(plate(2), {0.04F, 0, 0, 0.04F, 0, 0.04F}), "cov", 1).mean(), 0.2, 1e-7);
}

TEST(VertexNoise, MergedVerticesHaveTheMeanOfAll) {
  Mesh mesh = withSigma(plate(1), 0);
  std::get<Buffer<float>>(mesh.properties[0].values) = {1, 2, 4, 0};
  VertexNoise noise(mesh, "sigma", 1);
  noise.merge(0, 1);
  EXPECT_DOUBLE_EQ(noise.variance(0, {0, 0, 1}), 2.5);
  noise.merge(0, 2);
  EXPECT_DOUBLE_EQ(noise.variance(0, {0, 0, 1}), 7);
  noise.merge(3, 0);
  EXPECT_DOUBLE_EQ(noise.variance(3, {0, 0, 1}), 5.25);
}

TEST(VertexNoise, RefusesWhatIsNoNoise) {
  const auto sigma = [](float value) {
    Mesh mesh = withSigma(plate(2), 0.5F);
    std::get<Buffer<float>>(mesh.properties[0].values)[7] = value;
    return complaint(mesh, "sigma");
  };
  EXPECT_EQ(sigma(0), "");
  EXPECT_EQ(sigma(-0.25F), "the property 'sigma' of vertex 7 is -0.25; the limit is a finite number >= 0");
  EXPECT_NE(sigma(std::numeric_limits<float>::quiet_NaN()).find("vertex 7 is nan"), std::string::npos);
  EXPECT_NE(sigma(std::numeric_limits<float>::infinity()).find("vertex 7 is inf"), std::string::npos);
  EXPECT_EQ(complaint(plate(2), "sigma"), "the vertices have no property 'sigma'");
  Mesh pair = plate(1);
  pair.properties = {{"sigma", 2, Buffer<float>(8)}};
  EXPECT_EQ(complaint(pair, "sigma"), "the property 'sigma' has 2 numbers per vertex, not 1");
}

TEST(VertexNoise, RefusesWhatIsNoCovariance) {
  const Mesh good = withCovariance(plate(1), {1, 0.5F, 0, 1, 0, 1});
  EXPECT_EQ(complaint(good, "cov"), "");
  // Rounding to single precision takes an eigenvalue of this matrix of rank one a little below 0.
  EXPECT_EQ(complaint(withCovariance(plate(1), {0.01F, 0.03F, 0.07F, 0.09F, 0.21F, 0.49F}), "cov"), "");
  Mesh bad = good;
  std::get<Buffer<float>>(bad.properties[1].values)[2] = 2;
  EXPECT_EQ(complaint(bad, "cov"), "the covariance of vertex 2 has the eigenvalue -1; the limit is 0");
  std::get<Buffer<float>>(bad.properties[1].values)[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(complaint(bad, "cov"), "the covariance of vertex 1 is not finite");
  bad = good;
  bad.properties.pop_back();
  EXPECT_EQ(complaint(bad, "cov"), "the vertices have no property 'covzz'");
  EXPECT_EQ(complaint(plate(1), "cov"), "the vertices have no property 'cov'");
}

// A sphere whose vertices have noise where x > 0, the more, the larger x; mean edges are 1 / 25 long.
struct HalfNoisy {
  Mesh clean = sphere(40), noisy = clean;

  HalfNoisy() {
    constexpr double kMost = 0.5 / 25;
    Mesh moved = clean;
    test::addNoise(moved, 1);
    Buffer<float> sigma;
    for (std::size_t v = 0; v < clean.positions.size(); ++v) {
      sigma.push_back(static_cast<float>(kMost * std::max(0.0, double{clean.positions[v].x})));
      noisy.positions[v] += (moved.positions[v] - clean.positions[v]) * sigma[v];
    }
    noisy.properties = {{"sigma", 1, sigma}};
  }

  /// Mean distances of the clean sphere's vertices from a mesh, where x < 0 and where x > 0; and the share of the
  /// mesh's vertices where x > 1/3.
  [[nodiscard]] std::array<double, 3> figures(const Mesh& mesh) const {
    std::array<double, 3> result{};
    std::array<double, 2> count{};
    const Buffer<double> all = vertexDistances(clean, mesh);
    for (std::size_t v = 0; v < all.size(); ++v) {
      const std::size_t half = clean.positions[v].x > 0 ? 1 : 0;
      result[half] += all[v];
      ++count[half];
    }
    for (std::size_t half = 0; half < 2; ++half) result[half] /= count[half];
    for (const Vec3f& p : mesh.positions)
      result[2] += (p.x > 1.0F / 3 ? 1.0 : 0.0) / static_cast<double>(mesh.positions.size());
    return result;
  }
};

TEST(VertexNoise, SpendsFewTrianglesInNoise) {
  const HalfNoisy ball;
  for (const double ratio : {0.05, 0.15, 0.3}) {
    const auto [cleanHalf, noisyHalf, share] = ball.figures(decimate(ball.noisy, {.ratio = ratio}));
    const auto [cleanWith, noisyWith, shareWith] =
        ball.figures(decimate(ball.noisy, {.ratio = ratio, .sigmaProperty = "sigma"}));
    EXPECT_LT(cleanWith, 0.7 * cleanHalf) << ratio;
    EXPECT_LT(noisyWith, 0.9 * noisyHalf) << ratio;
    EXPECT_LT(shareWith, 0.6 * share) << ratio;
  }
}

TEST(VertexNoise, IsotropicCovariancesDoAsStandardDeviations) {
  HalfNoisy ball;
  const auto sigma = std::get<Buffer<float>>(ball.noisy.properties[0].values);
  Buffer<float> squares;
  for (const float s : sigma) squares.push_back(s * s);
  for (const char* const name : kNames) {
    const bool diagonal = name[3] == name[4];
    ball.noisy.properties.push_back({name, 1, diagonal ? squares : Buffer<float>(sigma.size(), 0.0F)});
  }
  const auto scalar = ball.figures(decimate(ball.noisy, {.ratio = 0.1, .sigmaProperty = "sigma"}));
  const auto full = ball.figures(decimate(ball.noisy, {.ratio = 0.1, .sigmaProperty = "cov"}));
  for (std::size_t i = 0; i < scalar.size(); ++i) EXPECT_NEAR(full[i] / scalar[i], 1, 0.05);
}

bool sameMesh(const Mesh& a, const Mesh& b) { return a.positions == b.positions && a.triangles == b.triangles; }

TEST(VertexNoise, NoNoiseIsThatOfACleanMesh) {
  const Mesh ball = withSigma(sphere(20), 0);
  DecimateReport report;
  const Mesh with = decimate(ball, {.ratio = 0.1, .sigmaProperty = "sigma"}, &report);
  EXPECT_EQ(report.noise, 0);
  EXPECT_TRUE(sameMesh(with, decimate(ball, {.ratio = 0.1, .sigmaNormal = 1e-4, .sigmaPosition = 1e-4, .memory = 0})));
}

TEST(VertexNoise, ChoosesForEachVertexWhatIsNotSet) {
  const HalfNoisy ball;
  const DecimateOptions chosen{.ratio = 0.1, .sigmaProperty = "sigma", .fit = false};
  DecimateReport report;
  const Mesh mesh = decimate(ball.noisy, chosen, &report);
  DecimateOptions sigma = chosen, memory = chosen, position = chosen;
  sigma.sigmaNormal = report.sigmaNormal;
  EXPECT_FALSE(sameMesh(decimate(ball.noisy, sigma), mesh));
  memory.memory = report.memory;
  EXPECT_FALSE(sameMesh(decimate(ball.noisy, memory), mesh));
  position.sigmaPosition = report.sigmaPosition;
  EXPECT_TRUE(sameMesh(decimate(ball.noisy, position), mesh)) << "one for all";
  sigma.sigmaNormal = 0.3;
  static_cast<void>(decimate(ball.noisy, sigma, &report));
  EXPECT_EQ(report.sigmaNormal, 0.3);
}

TEST(VertexNoise, ScalesWithTheMeshAndNotWithThreads) {
  const HalfNoisy ball;
  const DecimateOptions options{.ratio = 0.1, .sigmaProperty = "sigma"};
  const auto with = [&](int threads) { return withThreads(threads, [&] { return decimate(ball.noisy, options); }); };
  const Mesh one = with(1);
  for (const int threads : {2, 5}) EXPECT_TRUE(sameMesh(with(threads), one)) << threads;
  Mesh scaled = ball.noisy, expected = one;
  for (Vec3f& p : scaled.positions) p *= 8;
  for (float& s : std::get<Buffer<float>>(scaled.properties[0].values)) s *= 8;
  for (Vec3f& p : expected.positions) p *= 8;
  EXPECT_TRUE(sameMesh(decimate(scaled, options), expected));
}

TEST(VertexNoise, AnySizeOfNoiseGivesAMesh) {
  for (const float sigma : {1e-30F, 1e3F, 1e30F})
    for (const QuadricKind kind : {QuadricKind::kPlane, QuadricKind::kTriangle, QuadricKind::kProbabilisticPlane,
                                   QuadricKind::kProbabilisticTriangle, QuadricKind::kPoint}) {
      const Mesh fewer =
          decimate(withSigma(sphere(12), sigma), {.faces = 200, .quadric = kind, .sigmaProperty = "sigma"});
      EXPECT_EQ(fewer.triangles.size(), 200u);
      for (const Vec3f& p : fewer.positions) ASSERT_NEAR(length(vecCast<double>(p)), 1, 0.2);
    }
}

}  // namespace
}  // namespace pdc::detail
