#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "pdc/points/gaussian_mixture.h"
#include "pdc/points/point_cloud.h"

namespace pdc::test {

/// Points on the unit sphere, with noise along each axis; their normals are not known.
inline PointCloud noisySphere(std::size_t n, double noise, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d d{normal(random), normal(random), normal(random)};
    const Vec3d jitter{normal(random), normal(random), normal(random)};
    cloud.positions.push_back(d * (1 / length(d)) + jitter * noise);
  }
  return cloud;
}

/// Flat Gaussians on a square lattice in the plane z = height.
inline void addSheet(GaussianMixture& mixture, int side, double height, double along, double across) {
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      // A lattice without a shift has ties everywhere.
      mixture.means.push_back({i + 0.1 * std::sin(7.0 * j), j + 0.1 * std::cos(5.0 * i), height});
      mixture.covariances.push_back({along * along, 0, 0, along * along, 0, across * across});
    }
  }
  mixture.weights.assign(mixture.means.size(), 1 / static_cast<double>(mixture.means.size()));
}

}  // namespace pdc::test
