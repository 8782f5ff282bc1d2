#pragma once

#include <memory>

#include "pdc/sample/vdb/grid_source.h"
#include "sample/stencils/value_noise.h"
#include "sample/vdb/grid_sampler.h"

namespace pdc::detail {

/// The grids that say what is known of another grid's values: their standard deviations and weights.
class NoiseGrids {
 public:
  /// \throws Error for a grid that is `grid` itself, has another transform or is not scalar.
  NoiseGrids(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options);

  /// What to make planes' noise of. Valid as long as this is.
  [[nodiscard]] ValueNoise noise() const { return {mSigma.get(), mWeight.get()}; }
  /// The values of the weight grid; null if there is none.
  [[nodiscard]] const GridSampler* weight() const { return mWeight.get(); }
  /// The number of active values that are negative or not finite.
  [[nodiscard]] std::size_t refused() const { return mRefused; }

 private:
  std::unique_ptr<const GridSampler> open(const openvdb::GridBase::ConstPtr& grid,
                                          const openvdb::GridBase::ConstPtr& companion, const char* name);

  std::size_t mRefused = 0;
  std::unique_ptr<const GridSampler> mSigma, mWeight;
};

}  // namespace pdc::detail
