#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdc/math/sym_mat3.h"
#include "pdc/monitor.h"
#include "pdc/points/gaussian_mixture.h"

namespace pdc::detail {

/// The Bhattacharyya coefficient of two Gaussians, in (0, 1] (equation 19 of Preiner et al. 2019).
[[nodiscard]] double bhattacharyya(const Vec3d& meanA, const SymMat3<double>& covarianceA, const Vec3d& meanB,
                                   const SymMat3<double>& covarianceB);

/// Which Gaussians of a mixture overlap, and how much: all pairs whose Bhattacharyya coefficient is `least` at least,
/// but for those whose normals point to opposite sides.
class Overlaps {
 public:
  struct Neighbour {
    std::uint32_t index;
    double coefficient;
  };

  /// \throws Error if there are too many pairs for the memory; Cancelled.
  Overlaps(const GaussianMixture& mixture, double least, const Monitor& monitor);

  /// By ascending index.
  [[nodiscard]] std::span<const Neighbour> of(std::size_t i) const {
    return std::span(mNeighbours).subspan(mBegin[i], mBegin[i + 1] - mBegin[i]);
  }
  /// 0 for Gaussians that are no neighbours.
  [[nodiscard]] double coefficient(std::uint32_t i, std::uint32_t j) const;

 private:
  std::vector<std::size_t> mBegin;
  std::vector<Neighbour> mNeighbours;
};

}  // namespace pdc::detail
