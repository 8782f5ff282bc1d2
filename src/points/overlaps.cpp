#include "points/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "parallel/block_progress.h"
#include "parallel/for_each_in_parallel.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "points/gaussian_terms.h"
#include "points/point_tree.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kChunk = 64;

struct Pair {
  std::uint32_t a, b;
  double coefficient;
};

double coefficientOf(const Vec3d& distance, const SymMat3<double>& mean, double logDeterminants) {
  const Vec3d solved = solveLdlt(mean, distance).value_or(Vec3d{0, 0, 0});
  return std::exp(-0.125 * dot(distance, solved) - 0.5 * std::log(determinant(mean)) + 0.25 * logDeterminants);
}

}  // namespace

double bhattacharyya(const Vec3d& meanA, const SymMat3<double>& covarianceA, const Vec3d& meanB,
                     const SymMat3<double>& covarianceB) {
  const double logs = std::log(determinant(covarianceA)) + std::log(determinant(covarianceB));
  return coefficientOf(meanA - meanB, (covarianceA + covarianceB) * 0.5, logs);
}

Overlaps::Overlaps(const GaussianMixture& mixture, double least, const Monitor& monitor) {
  const std::size_t n = mixture.size();
  const PointTree tree(mixture.means);
  std::vector<double> reach(n), logs(n);
  // A pair has at most the coefficient that its distance along the longest axis of the mean covariance leaves, and that
  // axis is at most the longer one's of the two.
  const double factor = std::sqrt(-8 * std::log(least)) * (1 + 1e-12);
  forEachInParallel(n, kChunk, [&](std::uint32_t i) {
    reach[i] = factor * longestDeviation(mixture.covariances[i]);
    logs[i] = std::log(determinant(mixture.covariances[i]));
  });
  std::vector<std::vector<Pair>> parts((n + kChunk - 1) / kChunk);
  BlockProgress progress(monitor, "overlaps", parts.size());
  const std::size_t available = availableMemory();
  std::atomic<std::size_t> found{0};
  forEachInParallel(parts.size(), 1, [&](std::uint32_t k) {
    std::vector<Pair>& part = parts[k];
    for (std::uint32_t i = static_cast<std::uint32_t>(k * kChunk); i < std::min((k + 1) * kChunk, n); ++i) {
      tree.visitWithin(mixture.means[i], reach[i], [&](std::uint32_t j, double) {
        // Each pair is found from the end that reaches farther.
        if (j == i || reach[j] > reach[i] || (reach[j] == reach[i] && j < i)) return;
        if (!mixture.normals.empty() && dot(mixture.normals[i], mixture.normals[j]) < 0) return;
        const double coefficient =
            coefficientOf(mixture.means[i] - mixture.means[j], (mixture.covariances[i] + mixture.covariances[j]) * 0.5,
                          logs[i] + logs[j]);
        if (coefficient >= least) part.push_back({i, j, std::min(coefficient, 1.0)});
      });
    }
    // A pair takes 16 bytes in the list and 32 among the neighbours.
    const std::size_t pairs = found.fetch_add(part.size(), std::memory_order_relaxed) + part.size();
    if (available > 0 && pairs > available / 64)
      throw Error(fmt::format("more than {} pairs of Gaussians overlap; the memory holds no more", available / 64));
    progress.advance(1);
  });
  mBegin.assign(n + 1, 0);
  for (const std::vector<Pair>& part : parts)
    for (const Pair& pair : part) ++mBegin[pair.a + 1], ++mBegin[pair.b + 1];
  for (std::size_t i = 0; i < n; ++i) mBegin[i + 1] += mBegin[i];
  mNeighbours.resize(mBegin[n]);
  std::vector<std::size_t> next(mBegin.begin(), mBegin.end() - 1);
  for (const std::vector<Pair>& part : parts) {
    for (const Pair& pair : part) {
      mNeighbours[next[pair.a]++] = {pair.b, pair.coefficient};
      mNeighbours[next[pair.b]++] = {pair.a, pair.coefficient};
    }
  }
  forEachInParallel(n, kChunk, [&](std::uint32_t i) {
    std::sort(mNeighbours.begin() + static_cast<std::ptrdiff_t>(mBegin[i]),
              mNeighbours.begin() + static_cast<std::ptrdiff_t>(mBegin[i + 1]),
              [](const Neighbour& a, const Neighbour& b) { return a.index < b.index; });
  });
}

double Overlaps::coefficient(std::uint32_t i, std::uint32_t j) const {
  const auto all = of(i);
  const auto at =
      std::lower_bound(all.begin(), all.end(), j, [](const Neighbour& a, std::uint32_t b) { return a.index < b; });
  return at != all.end() && at->index == j ? at->coefficient : 0;
}

}  // namespace pdc::detail
