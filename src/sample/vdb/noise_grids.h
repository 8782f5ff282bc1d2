#pragma once

#include <memory>

#include "pdc/sample/plane_noise.h"
#include "pdc/sample/vdb/grid_source.h"
#include "sample/vdb/grid_sampler.h"

namespace pdc::detail {

/// The grids that say what is known of another grid's values: their standard deviations and weights.
class NoiseGrids {
 public:
  /// \throws Error for a grid that is `grid` itself, has another transform or is not scalar.
  NoiseGrids(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options);

  [[nodiscard]] bool any() const { return mSigma != nullptr || mWeight != nullptr; }
  /// The values of the weight grid; null if there is none.
  [[nodiscard]] const GridSampler* weight() const { return mWeight.get(); }
  [[nodiscard]] bool hasSigma() const { return mSigma != nullptr; }
  /// The number of active values that are negative or not finite.
  [[nodiscard]] std::size_t refused() const { return mRefused; }

  /// See HermiteSource::fillNoise. \param values are those of the grid itself.
  void fill(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite, const GridSampler& values,
            PlaneNoise& noise) const;
  /// The largest σ at the block's crossings, in the units of the values. \pre hasSigma()
  [[nodiscard]] double largestSigma(const Coord& block, const EdgeIndex& edges, const HermiteBlock& hermite) const;

 private:
  std::unique_ptr<const GridSampler> open(const openvdb::GridBase::ConstPtr& grid,
                                          const openvdb::GridBase::ConstPtr& companion, const char* name);

  std::size_t mRefused = 0;
  std::unique_ptr<const GridSampler> mSigma, mWeight;
};

}  // namespace pdc::detail
