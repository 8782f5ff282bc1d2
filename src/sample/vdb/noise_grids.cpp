#include "sample/vdb/noise_grids.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>

#include "sample/meaning/contourable_grids.h"

namespace pdc::detail {
namespace {

/// Counts active values that are negative or not finite.
std::size_t countRefused(const openvdb::GridBase& grid) {
  std::size_t refused = 0;
  visitContourable(grid, [&](const auto& typed) {
    for (auto it = typed.cbeginValueOn(); it; ++it) {
      const auto v = static_cast<double>(*it);
      if (!(v >= 0 && std::isfinite(v))) ++refused;
    }
  });
  return refused;
}

}  // namespace

NoiseGrids::NoiseGrids(const openvdb::GridBase::ConstPtr& grid, const GridSourceOptions& options)
    : mSigma(open(grid, options.sigma, "sigma")), mWeight(open(grid, options.weight, "weight")) {}

std::unique_ptr<const GridSampler> NoiseGrids::open(const openvdb::GridBase::ConstPtr& grid,
                                                    const openvdb::GridBase::ConstPtr& companion, const char* name) {
  if (companion == nullptr) return nullptr;
  if (companion == grid) throw Error(fmt::format("the {} grid is the grid itself", name));
  if (companion->transform() != grid->transform())
    throw Error(fmt::format("the {} grid '{}' has another transform than the grid", name, companion->getName()));
  const ValueReading plain{.acceptNonFinite = true, .clamp = std::numeric_limits<double>::infinity()};
  auto sampler = makeGridSampler(companion, plain);
  if (sampler == nullptr)
    throw Error(
        fmt::format("the {} grid is of type {}; {} can be used", name, companion->valueType(), contourableTypeNames()));
  mRefused += countRefused(*companion);
  return sampler;
}

}  // namespace pdc::detail
