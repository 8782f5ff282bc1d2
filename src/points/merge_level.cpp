#include "points/merge_level.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "parallel/block_progress.h"
#include "parallel/for_each_in_parallel.h"
#include "parallel/machine_memory.h"
#include "pdc/error.h"
#include "points/gaussian_terms.h"
#include "points/point_tree.h"
#include "points/spatial_order.h"

namespace pdc::detail {
namespace {

constexpr std::size_t kGrain = 256;
/// Flatter covariances than this, as a share of the largest eigenvalue, lose digits where they are inverted.
constexpr double kLeastShare = 1e-6;
constexpr std::size_t kPairBytes = 24;  ///< Pairs and what else is held of each while they are made.

/// The children of each parent, one after the other, with the logarithm of ws L(Θs|Θi), later the responsibility.
struct Pairs {
  std::vector<std::size_t> begin;  ///< Of each parent's, and the end.
  Buffer<std::uint32_t> child;
  Buffer<double> value;
};

/// Gaussians with equal means stay in the order that they have.
GaussianMixture sortedInSpace(const GaussianMixture& mixture) {
  const Buffer<std::uint32_t> order = spatialOrder(mixture.means, std::less<std::uint32_t>());
  return {inOrder(mixture.means, order), inOrder(mixture.covariances, order), inOrder(mixture.weights, order),
          inOrder(mixture.normals, order), inOrder(mixture.colours, order)};
}

class Level {
 public:
  Level(const GaussianMixture& mixture, const LevelOptions& options, const Monitor& monitor)
      : mMixture(mixture), mOptions(options), mMonitor(monitor), mTree(mixture.means) {
    mIsParent.resize(mixture.size());
    mLog.resize(mixture.size());
    forEachInParallel(mixture.size(), kGrain, [&](std::uint32_t i) {
      mIsParent[i] = isParent(mixture.means[i], options.level);
      mLog[i] = std::log(determinant(mixture.covariances[i]));
    });
    for (std::uint32_t i = 0; i < mixture.size(); ++i)
      if (mIsParent[i] != 0) mParents.push_back(i);
    for (const std::uint32_t p : mParents) mGaussians.emplace_back(mixture.means[p], mixture.covariances[p]);
    for (const std::uint32_t p : mParents) mWeights.push_back(mixture.weights[p]);
  }

  GaussianMixture run(MixtureLevelReport& report) {
    report.before = mMixture.size();
    report.parents = mParents.size();
    findPairs();
    transpose();
    for (int iteration = 0; iteration < mOptions.iterations; ++iteration) {
      mMonitor.throwIfStopped();
      if (iteration > 0) setLikelihoods();
      report.logLikelihood.push_back(expect());
      report.clamped = maximize();
    }
    GaussianMixture result = gatherResult();
    report.after = result.size();
    report.kept = report.after - report.parents;
    return result;
  }

 private:
  [[nodiscard]] bool areOpposite(std::uint32_t i, std::uint32_t j) const {
    return !mMixture.normals.empty() && dot(mMixture.normals[i], mMixture.normals[j]) < 0;
  }

  [[nodiscard]] double logLikelihood(std::size_t parent, std::uint32_t child, const PairTerms& pair) const {
    const double power = mMixture.weights[child] * mOptions.samples;
    return std::log(mWeights[parent]) + power * logLikelihoodOfOne(pair, mGaussians[parent].logDeterminant);
  }

  /// Calls found(child, logarithm of its likelihood) for a parent's children, ascending.
  template <typename Found>
  void visitChildren(std::size_t parent, const Found& found) const {
    const std::uint32_t self = mParents[parent];
    const GaussianTerms& gaussian = mGaussians[parent];
    const double most = 0.5 * mOptions.alpha * mOptions.alpha;
    // Nothing farther away has a smaller divergence, whatever its covariance is.
    const double radius = mOptions.alpha * longestDeviation(gaussian.covariance) * (1 + 1e-12);
    mTree.visitWithin(gaussian.mean, radius, [&](std::uint32_t i, double) {
      if ((mIsParent[i] != 0 && i != self) || areOpposite(i, self)) return;
      const PairTerms pair(gaussian, mMixture.means[i], mMixture.covariances[i]);
      if (i == self || divergence(pair, gaussian.logDeterminant, mLog[i]) <= most)
        found(i, logLikelihood(parent, i, pair));
    });
  }

  /// \throws Error if a sample of the parents says that the memory does not hold the pairs of all.
  void forecastPairs() const {
    constexpr std::size_t kSamples = 256;
    const std::size_t step = std::max<std::size_t>(1, mParents.size() / kSamples);
    double pairs = 0;
    for (std::size_t p = 0; p < mParents.size(); p += step) {
      mMonitor.throwIfStopped();
      visitChildren(p, [&](std::uint32_t, double) { pairs += static_cast<double>(step); });
    }
    const auto available = static_cast<double>(availableMemory());
    const double most = std::numeric_limits<std::uint32_t>::max();
    if (pairs > most || (available > 0 && pairs * kPairBytes > available))
      throw Error(fmt::format(
          "some {:.3g} pairs of Gaussians are near enough to be merged; the limit is {:.3g}: take a smaller "
          "sigma0 or alpha",
          pairs, available > 0 ? std::min(most, available / kPairBytes) : most));
  }

  void findPairs() {
    forecastPairs();
    struct Part {
      std::vector<std::uint32_t> child, count;
      std::vector<double> value;
    };
    std::vector<Part> parts((mParents.size() + kGrain - 1) / kGrain);
    BlockProgress progress(mMonitor, "mixture", parts.size());
    forEachInParallel(parts.size(), 1, [&](std::uint32_t k) {
      Part& part = parts[k];
      for (std::size_t p = k * kGrain; p < std::min((k + 1) * kGrain, mParents.size()); ++p) {
        const std::size_t before = part.child.size();
        visitChildren(p, [&](std::uint32_t child, double value) {
          part.child.push_back(child);
          part.value.push_back(value);
        });
        part.count.push_back(static_cast<std::uint32_t>(part.child.size() - before));
      }
      progress.advance(1);
    });
    mPairs.begin.assign(1, 0);
    for (const Part& part : parts)
      for (const std::uint32_t count : part.count) mPairs.begin.push_back(mPairs.begin.back() + count);
    mPairs.child.resize(mPairs.begin.back());
    mPairs.value.resize(mPairs.begin.back());
    forEachInParallel(parts.size(), 1, [&](std::uint32_t k) {
      const std::size_t at = mPairs.begin[k * kGrain];
      std::copy(parts[k].child.begin(), parts[k].child.end(), mPairs.child.data() + at);
      std::copy(parts[k].value.begin(), parts[k].value.end(), mPairs.value.data() + at);
      parts[k] = {};
    });
  }

  /// Lists for each child the pairs that it is in, by ascending parent.
  void transpose() {
    mPairsBegin.assign(mMixture.size() + 1, 0);
    for (const std::uint32_t child : mPairs.child) ++mPairsBegin[child + 1];
    for (std::size_t i = 0; i < mMixture.size(); ++i) mPairsBegin[i + 1] += mPairsBegin[i];
    std::vector<std::size_t> next(mPairsBegin.begin(), mPairsBegin.end() - 1);
    mPairsOf.resize(mPairs.child.size());
    for (std::size_t e = 0; e < mPairs.child.size(); ++e)
      mPairsOf[next[mPairs.child[e]]++] = static_cast<std::uint32_t>(e);
  }

  void setLikelihoods() {
    forEachInParallel(mParents.size(), kGrain, [&](std::uint32_t p) {
      for (std::size_t e = mPairs.begin[p]; e < mPairs.begin[p + 1]; ++e) {
        const std::uint32_t child = mPairs.child[e];
        const PairTerms pair(mGaussians[p], mMixture.means[child], mMixture.covariances[child]);
        mPairs.value[e] = logLikelihood(p, child, pair);
      }
    });
  }

  /// Makes responsibilities of the likelihoods. \returns the logarithm of the whole likelihood.
  double expect() {
    Buffer<double> logs(mMixture.size());
    forEachInParallel(mMixture.size(), kGrain, [&](std::uint32_t i) {
      const std::size_t begin = mPairsBegin[i], end = mPairsBegin[i + 1];
      logs[i] = 0;
      if (begin == end) return;
      double largest = -std::numeric_limits<double>::infinity(), sum = 0;
      for (std::size_t e = begin; e < end; ++e) largest = std::max(largest, mPairs.value[mPairsOf[e]]);
      for (std::size_t e = begin; e < end; ++e) sum += std::exp(mPairs.value[mPairsOf[e]] - largest);
      for (std::size_t e = begin; e < end; ++e) {
        double& value = mPairs.value[mPairsOf[e]];
        value = std::exp(value - largest) / sum;
      }
      logs[i] = largest + std::log(sum);
    });
    double total = 0;
    for (const double log : logs) total += log;
    return total;
  }

  /// The Gaussians that the responsibilities make. \returns how many covariances were clamped.
  std::size_t maximize() {
    std::atomic<std::size_t> clamped{0};
    forEachInParallel(mParents.size(), kGrain, [&](std::uint32_t p) {
      const Vec3d reference = mGaussians[p].mean;
      double weight = 0;
      Vec3d first{0, 0, 0};
      SymMat3<double> second = SymMat3<double>::zero();
      for (std::size_t e = mPairs.begin[p]; e < mPairs.begin[p + 1]; ++e) {
        const std::uint32_t child = mPairs.child[e];
        const double share = mPairs.value[e] * mMixture.weights[child];
        const Vec3d d = mMixture.means[child] - reference;
        weight += share;
        first += d * share;
        second += (mMixture.covariances[child] + outer(d)) * share;
      }
      const Vec3d shift = first * (1 / weight);
      SymMat3<double> covariance = second * (1 / weight) - outer(shift);
      if (clamp(covariance)) clamped.fetch_add(1, std::memory_order_relaxed);
      mWeights[p] = weight;
      mGaussians[p] = GaussianTerms(reference + shift, covariance);
    });
    return clamped;
  }

  static bool clamp(SymMat3<double>& covariance) {
    const Eigen3 eigen = eigenSymmetric(covariance);
    const double least = kLeastShare * eigen.value[0];
    if (eigen.value[2] >= least) return false;
    covariance = SymMat3<double>::zero();
    for (std::size_t k = 0; k < 3; ++k) covariance += outer(eigen.vector[k]) * std::max(eigen.value[k], least);
    return true;
  }

  /// The sum of what the children have of a kind, by their shares of a parent.
  [[nodiscard]] Vec3d sumOver(std::size_t parent, const Buffer<Vec3f>& values) const {
    Vec3d sum{0, 0, 0};
    double weight = 0;
    for (std::size_t e = mPairs.begin[parent]; e < mPairs.begin[parent + 1]; ++e) {
      const double share = mPairs.value[e] * mMixture.weights[mPairs.child[e]];
      sum += vecCast<double>(values[mPairs.child[e]]) * share;
      weight += share;
    }
    return sum * (1 / weight);
  }

  [[nodiscard]] GaussianMixture gatherResult() const {
    GaussianMixture result;
    for (std::size_t p = 0; p < mParents.size(); ++p) {
      result.means.push_back(mGaussians[p].mean);
      result.covariances.push_back(mGaussians[p].covariance);
      result.weights.push_back(mWeights[p]);
      if (!mMixture.normals.empty()) {
        const Vec3d sum = sumOver(p, mMixture.normals);
        const double size = length(sum);
        result.normals.push_back(vecCast<float>(size > 0 ? sum * (1 / size) : sum));
      }
      if (!mMixture.colours.empty()) result.colours.push_back(vecCast<float>(sumOver(p, mMixture.colours)));
    }
    for (std::uint32_t i = 0; i < mMixture.size(); ++i) {
      if (mPairsBegin[i] != mPairsBegin[i + 1]) continue;
      result.means.push_back(mMixture.means[i]);
      result.covariances.push_back(mMixture.covariances[i]);
      result.weights.push_back(mMixture.weights[i]);
      if (!mMixture.normals.empty()) result.normals.push_back(mMixture.normals[i]);
      if (!mMixture.colours.empty()) result.colours.push_back(mMixture.colours[i]);
    }
    return sortedInSpace(result);
  }

  const GaussianMixture& mMixture;
  LevelOptions mOptions;
  const Monitor& mMonitor;
  PointTree mTree;
  Buffer<std::uint8_t> mIsParent;
  Buffer<double> mLog;  ///< ln |Σ| of each Gaussian.
  std::vector<std::uint32_t> mParents;
  std::vector<GaussianTerms> mGaussians;  ///< Of the parents, as they are at present.
  std::vector<double> mWeights;           ///< Likewise.
  Pairs mPairs;
  std::vector<std::size_t> mPairsBegin;  ///< Where in mPairsOf each child's begin, and the end.
  Buffer<std::uint32_t> mPairsOf;
};

}  // namespace

bool isParent(const Vec3d& mean, std::uint64_t level) {
  std::uint64_t hash = 0x9e3779b97f4a7c15U * (level + 1);
  for (const double coordinate : {mean.x, mean.y, mean.z}) {
    hash ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);  // Minus zero becomes zero.
    hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9U;
    hash = (hash ^ hash >> 27) * 0x94d049bb133111ebU;
    hash ^= hash >> 31;
  }
  return hash % 3 == 0;
}

GaussianMixture mergeLevel(const GaussianMixture& mixture, const LevelOptions& options, MixtureLevelReport& report,
                           const Monitor& monitor) {
  return Level(mixture, options, monitor).run(report);
}

}  // namespace pdc::detail
