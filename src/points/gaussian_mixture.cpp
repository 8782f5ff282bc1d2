#include "pdc/points/gaussian_mixture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "parallel/for_each_in_parallel.h"
#include "pdc/error.h"
#include "points/merge_level.h"
#include "points/point_tree.h"
#include "points/spatial_order.h"

namespace pdc {
namespace {

constexpr std::size_t kGrain = 1024;
/// A level that leaves more than this of its Gaussians is the last.
constexpr double kStalled = 0.95;

void checkOptions(const MixtureOptions& options) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("gaussianMixture: {}", what));
  };
  require(!options.sigma0 || (*options.sigma0 > 0 && std::isfinite(*options.sigma0)), "sigma0 must be above 0");
  require(options.alpha > 0, "alpha must be above 0");
  require(options.levels >= 0 && options.levels <= 100, "levels must be 0 to 100");
  require(options.iterations >= 1 && options.iterations <= 1000, "iterations must be 1 to 1000");
}

/// Tells points of one position apart by what else is known of them.
struct BeforeAtOnePlace {
  const PointCloud& cloud;

  bool operator()(std::uint32_t i, std::uint32_t j) const {
    if (!cloud.normals.empty()) {
      const Vec3f &a = cloud.normals[i], &b = cloud.normals[j];
      if (!(a == b)) return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
    if (!cloud.sigmas.empty() && cloud.sigmas[i] != cloud.sigmas[j]) return cloud.sigmas[i] < cloud.sigmas[j];
    return !cloud.colours.empty() && cloud.colours[i] < cloud.colours[j];
  }
};

/// Points as Gaussians in spatial order, those at one place as one. Covariances hold the squares of the points' own
/// standard deviations only.
GaussianMixture gaussiansOf(const PointCloud& cloud) {
  const Buffer<std::uint32_t> order = detail::spatialOrder(cloud.positions, BeforeAtOnePlace{cloud});
  std::vector<std::size_t> begin;  // Of each place's points in `order`, and the end.
  for (std::size_t i = 0; i < order.size(); ++i)
    if (i == 0 || !(cloud.positions[order[i]] == cloud.positions[order[i - 1]])) begin.push_back(i);
  const std::size_t places = begin.size();
  begin.push_back(order.size());
  GaussianMixture mixture;
  mixture.means.resize(places);
  mixture.covariances.resize(places);
  mixture.weights.resize(places);
  if (!cloud.normals.empty()) mixture.normals.resize(places);
  if (!cloud.colours.empty()) mixture.colours.resize(places);
  const double each = 1 / static_cast<double>(order.size());
  detail::forEachInParallel(places, kGrain, [&](std::uint32_t k) {
    const auto count = static_cast<double>(begin[k + 1] - begin[k]);
    double variance = 0;
    Vec3d normal{0, 0, 0}, colour{0, 0, 0};
    for (std::size_t i = begin[k]; i < begin[k + 1]; ++i) {
      const std::uint32_t p = order[i];
      if (!cloud.sigmas.empty()) variance += double{cloud.sigmas[p]} * double{cloud.sigmas[p]} / count;
      if (!cloud.normals.empty()) normal += vecCast<double>(cloud.normals[p]);
      if (!cloud.colours.empty())
        for (int c = 0; c < 3; ++c) colour[c] += cloud.colours[p][static_cast<std::size_t>(c)] / count;
    }
    const double size = length(normal);
    mixture.means[k] = cloud.positions[order[begin[k]]];
    mixture.covariances[k] = SymMat3<double>::zero().plusDiagonal(variance);
    mixture.weights[k] = each * count;
    if (!cloud.normals.empty()) mixture.normals[k] = vecCast<float>(size > 0 ? normal * (1 / size) : normal);
    if (!cloud.colours.empty()) mixture.colours[k] = vecCast<float>(colour);
  });
  return mixture;
}

/// The side of the square that each point has of a surface with points as dense as near the median one.
double spacing(const Buffer<Vec3d>& points) {
  constexpr std::size_t kSamples = 10000, kNeighbours = 8;
  // Too few points have no eighth neighbour. The point itself is the first.
  const std::size_t neighbours = std::min(kNeighbours, points.size() - 1);
  if (neighbours == 0) throw Error("all points coincide, so they have no spacing: give sigma0");
  const detail::PointTree tree(points);
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSamples);
  std::vector<double> squares((points.size() + step - 1) / step);
  detail::forEachInParallel(squares.size(), 64, [&](std::uint32_t s) {
    squares[s] = tree.squaredDistanceToNearest(points[s * step], neighbours + 1);
  });
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle * std::numbers::pi / static_cast<double>(neighbours));
}

}  // namespace

GaussianMixture gaussianMixture(const PointCloud& cloud, const MixtureOptions& options, MixtureReport* report,
                                const Monitor& monitor) {
  checkOptions(options);
  checkPointCloud(cloud);
  monitor.throwIfStopped();
  GaussianMixture mixture = gaussiansOf(cloud);
  MixtureReport own;
  own.points = cloud.positions.size();
  own.duplicates = own.points - mixture.size();
  own.sigma0 = options.sigma0 ? *options.sigma0 : spacing(mixture.means);
  for (SymMat3<double>& covariance : mixture.covariances) covariance = covariance.plusDiagonal(own.sigma0 * own.sigma0);
  for (int level = 0; level < options.levels; ++level) {
    const detail::LevelOptions levelOptions{.alpha = options.alpha,
                                            .iterations = options.iterations,
                                            .samples = static_cast<double>(own.points),
                                            .level = static_cast<std::uint64_t>(level)};
    mixture = detail::mergeLevel(mixture, levelOptions, own.levels.emplace_back(), monitor);
    const MixtureLevelReport& last = own.levels.back();
    if (static_cast<double>(last.after) > kStalled * static_cast<double>(last.before)) break;
  }
  if (report != nullptr) *report = own;
  return mixture;
}

}  // namespace pdc
