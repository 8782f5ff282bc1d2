#include "pdc/points/gaussian_mixture.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "parallel/with_threads.h"
#include "pdc/error.h"
#include "pdc/math/solvers.h"
#include "points/merge_level.h"
#include "points/point_shapes.h"

namespace pdc {
namespace {

using test::noisySphere;

/// A mixture for the equations of appendix A, over all pairs.
struct Naive {
  std::vector<Eigen::Vector3d> mean;
  std::vector<Eigen::Matrix3d> covariance;
  std::vector<double> weight;
};

Eigen::Matrix3d toEigen(const SymMat3<double>& m) {
  Eigen::Matrix3d r;
  r << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return r;
}
Eigen::Vector3d toEigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

double naiveDivergence(const Naive& all, std::size_t child, std::size_t parent) {
  const Eigen::Matrix3d inverse = all.covariance[parent].inverse();
  const Eigen::Vector3d d = all.mean[child] - all.mean[parent];
  return 0.5 * ((inverse * all.covariance[child]).trace() + d.dot(inverse * d) - 3 +
                std::log(all.covariance[parent].determinant() / all.covariance[child].determinant()));
}

double naiveLikelihood(const Naive& all, std::size_t child, std::size_t parent, double samples) {
  const Eigen::Matrix3d inverse = all.covariance[parent].inverse();
  const Eigen::Vector3d d = all.mean[child] - all.mean[parent];
  const double density =
      std::exp(-0.5 * d.dot(inverse * d)) / std::sqrt((2 * std::numbers::pi * all.covariance[parent]).determinant());
  return std::pow(density * std::exp(-0.5 * (inverse * all.covariance[child]).trace()), all.weight[child] * samples);
}

Naive naiveLevel(const Naive& all, const std::vector<std::size_t>& parents, double alpha, double samples) {
  const std::size_t n = all.mean.size();
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(n, parents.size());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t s = 0; s < parents.size(); ++s) {
      const bool other = std::count(parents.begin(), parents.end(), i) > 0 && parents[s] != i;
      if (!other && naiveDivergence(all, i, parents[s]) <= alpha * alpha / 2)
        r(i, s) = all.weight[parents[s]] * naiveLikelihood(all, i, parents[s], samples);
    }
    if (r.row(i).sum() > 0) r.row(i) /= r.row(i).sum();
  }
  Naive result;
  for (std::size_t s = 0; s < parents.size(); ++s) {
    double weight = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < n; ++i) weight += r(i, s) * all.weight[i];
    for (std::size_t i = 0; i < n; ++i) {
      const double omega = r(i, s) * all.weight[i] / weight;
      mean += omega * all.mean[i];
      second += omega * (all.covariance[i] + all.mean[i] * all.mean[i].transpose());
    }
    result.mean.push_back(mean);
    result.covariance.push_back(second - mean * mean.transpose());
    result.weight.push_back(weight);
  }
  return result;
}

Naive toNaive(const GaussianMixture& mixture) {
  Naive all;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    all.mean.push_back(toEigen(mixture.means[i]));
    all.covariance.push_back(toEigen(mixture.covariances[i]));
    all.weight.push_back(mixture.weights[i]);
  }
  return all;
}

bool sameMixture(const GaussianMixture& a, const GaussianMixture& b) {
  return a.means == b.means && a.covariances == b.covariances && a.weights == b.weights && a.normals == b.normals &&
         a.colours == b.colours;
}

TEST(GaussianMixture, IsWhatTheEquationsSay) {
  const PointCloud cloud = noisySphere(300, 0.02);
  GaussianMixture before = gaussianMixture(cloud, {.sigma0 = 0.15, .levels = 0});
  for (std::uint64_t level = 0; level < 2; ++level) {
    MixtureLevelReport report;
    const GaussianMixture after = detail::mergeLevel(before, {2, 1, 300, level}, report, {});
    const Naive all = toNaive(before);
    std::vector<std::size_t> parents;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (detail::isParent(before.means[i], level)) parents.push_back(i);
    ASSERT_EQ(parents.size(), report.parents);
    const Naive expected = naiveLevel(all, parents, 2, 300);
    for (std::size_t s = 0; s < parents.size(); ++s) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < after.size(); ++k)
        nearest = std::min(nearest, (toEigen(after.means[k]) - expected.mean[s]).norm() +
                                        (toEigen(after.covariances[k]) - expected.covariance[s]).norm() +
                                        std::abs(after.weights[k] - expected.weight[s]));
      EXPECT_LT(nearest, 1e-9);
    }
    before = after;
  }
}

TEST(GaussianMixture, KeepsTheWeightTheMeanAndTheSecondMoment) {
  const PointCloud cloud = noisySphere(20000, 0.01);
  const auto moments = [](const GaussianMixture& mixture) {
    double weight = 0;
    Vec3d mean{0, 0, 0};
    SymMat3<double> second = SymMat3<double>::zero();
    for (std::size_t i = 0; i < mixture.size(); ++i) {
      weight += mixture.weights[i];
      mean += mixture.means[i] * mixture.weights[i];
      second += (mixture.covariances[i] + outer(mixture.means[i])) * mixture.weights[i];
    }
    return std::vector{weight,    mean.x,    mean.y,    mean.z,    second.xx,
                       second.xy, second.xz, second.yy, second.yz, second.zz};
  };
  const auto before = moments(gaussianMixture(cloud, {.sigma0 = 0.03, .levels = 0}));
  const GaussianMixture mixture = gaussianMixture(cloud, {.sigma0 = 0.03, .levels = 3});
  EXPECT_LT(mixture.size(), 3000U);
  const auto after = moments(mixture);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(after[k], before[k], 1e-12);
}

TEST(GaussianMixture, LikelihoodNeverFallsWithinALevelOfEqualWeights) {
  MixtureReport report;
  (void)gaussianMixture(noisySphere(5000, 0.02), {.levels = 1, .iterations = 12}, &report);
  ASSERT_EQ(report.levels.size(), 1U);
  EXPECT_EQ(report.levels[0].clamped, 0U);
  const auto& logs = report.levels[0].logLikelihood;
  ASSERT_EQ(logs.size(), 12U);
  for (std::size_t i = 1; i < logs.size(); ++i) EXPECT_GE(logs[i], logs[i - 1] - 1e-9 * std::abs(logs[i]));
  EXPECT_GT(logs.back(), logs.front() + 1);
}

TEST(GaussianMixture, DependsNeitherOnThreadsNorOnTheOrderOfThePoints) {
  PointCloud cloud = noisySphere(20000, 0.01);
  for (const Vec3d& p : cloud.positions) cloud.normals.push_back(vecCast<float>(p * (1 / length(p))));
  const GaussianMixture one = detail::withThreads(1, [&] { return gaussianMixture(cloud); });
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(sameMixture(one, detail::withThreads(threads, [&] { return gaussianMixture(cloud); })));
  PointCloud shuffled;
  std::vector<std::size_t> order(cloud.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
  for (const std::size_t i : order) {
    shuffled.positions.push_back(cloud.positions[i]);
    shuffled.normals.push_back(cloud.normals[i]);
  }
  EXPECT_TRUE(sameMixture(one, gaussianMixture(shuffled)));
}

TEST(GaussianMixture, CovariancesArePositiveDefiniteHoweverFlatTheNeighbourhoods) {
  // A plane and a line, which merge into Gaussians far wider than they are thick.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  PointCloud cloud;
  for (int i = 0; i < 3000; ++i)
    cloud.positions.push_back({10 * uniform(random), i % 2 == 0 ? uniform(random) : 0.5, 0});
  MixtureReport report;
  const GaussianMixture mixture = gaussianMixture(cloud, {.sigma0 = 1e-3, .alpha = 100, .levels = 5}, &report);
  std::size_t clamped = 0;
  for (const MixtureLevelReport& level : report.levels) clamped += level.clamped;
  EXPECT_GT(clamped, 0U);
  for (const SymMat3<double>& covariance : mixture.covariances) {
    const Eigen3 eigen = eigenSymmetric(covariance);
    ASSERT_GE(eigen.value[2], 0.99e-6 * eigen.value[0]);
  }
}

TEST(GaussianMixture, TakesPointsThatCoincideForOneOfTheirWeight) {
  PointCloud cloud;
  cloud.positions.assign(200000, {1, 2, 3});
  cloud.positions.push_back({2, 2, 3});
  MixtureReport report;
  const GaussianMixture mixture = gaussianMixture(cloud, {.sigma0 = 0.1}, &report);
  EXPECT_EQ(report.duplicates, 199999U);
  ASSERT_EQ(mixture.size(), 2U);
  EXPECT_NEAR(std::max(mixture.weights[0], mixture.weights[1]), 200000.0 / 200001, 1e-12);
}

TEST(GaussianMixture, NeverMergesOppositeNormals) {
  // The two sides of a sheet that is far thinner than sigma0.
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  PointCloud cloud;
  for (int i = 0; i < 4000; ++i) {
    const float side = i % 2 == 0 ? 1 : -1;
    cloud.positions.push_back({uniform(random), uniform(random), 0.001 * side});
    cloud.normals.push_back({0, 0, side});
  }
  for (const GaussianMixture mixture = gaussianMixture(cloud); const Vec3d& mean : mixture.means)
    ASSERT_NEAR(std::abs(mean.z), 0.001, 1e-12);
}

TEST(GaussianMixture, AddsTheDeviationOfAPointInSquares) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {1, 0, 0}};
  cloud.sigmas = {3, 0};
  const GaussianMixture mixture = gaussianMixture(cloud, {.sigma0 = 4, .levels = 0});
  EXPECT_EQ(mixture.covariances[0].xx, 25);
  EXPECT_EQ(mixture.covariances[1].zz, 16);
}

std::string complaint(const PointCloud& cloud, const MixtureOptions& options = {}) {
  try {
    (void)gaussianMixture(cloud, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(GaussianMixture, SaysWhatIsWrongWithPoints) {
  PointCloud cloud;
  EXPECT_EQ(complaint(cloud), "there are no points");
  cloud.positions.assign(5, {1, 2, 3});
  EXPECT_NE(complaint(cloud).find("all points coincide"), std::string::npos);
  EXPECT_EQ(complaint(cloud, {.sigma0 = 1}), "");
  cloud.positions[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(cloud).find("point 3 has a coordinate that is not finite"), std::string::npos);
  cloud.positions[3].y = 0;
  cloud.sigmas = {0, 0, -1, 0, 0};
  EXPECT_NE(complaint(cloud).find("the standard deviation of point 2 is -1"), std::string::npos);
  cloud.sigmas = {0};
  EXPECT_THROW((void)gaussianMixture(cloud), std::invalid_argument);
  EXPECT_THROW((void)gaussianMixture(noisySphere(10, 0), {.alpha = 0}), std::invalid_argument);
}

TEST(GaussianMixture, StopsOnRequest) {
  const std::atomic<bool> stop{true};
  EXPECT_THROW((void)gaussianMixture(noisySphere(1000, 0.01), {}, nullptr, {.stop = &stop}), Cancelled);
}

TEST(MixtureMesh, HoldsAllOfAMixture) {
  PointCloud cloud = noisySphere(2000, 0.01);
  for (const Vec3d& p : cloud.positions) cloud.normals.push_back(vecCast<float>(p * (1 / length(p))));
  cloud.colours.assign(2000, {10, 20, 30});
  const GaussianMixture mixture = gaussianMixture(cloud);
  const GaussianMixture read = mixtureOf(mixtureMesh(mixture));
  EXPECT_EQ(read.covariances, mixture.covariances);
  EXPECT_EQ(read.normals, mixture.normals);
  EXPECT_EQ(read.colours, mixture.colours);
  ASSERT_EQ(read.size(), mixture.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(length(read.means[i] - mixture.means[i]), 0, 1e-6);
    EXPECT_NEAR(read.weights[i], mixture.weights[i], 1e-15);
  }
}

}  // namespace
}  // namespace pdc
