#include "pdc/sample/sampled_source.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "parallel/isolated.h"

namespace pdc {

SampledSource::SampledSource(const HermiteSource& source, const Monitor& monitor)
    : mSource(source),
      mMap(source.map()),
      mBlocks(source.surfaceBlocks(monitor)),
      mFirst(mBlocks.coords.size() + 1, 0) {
  const std::size_t count = mBlocks.coords.size();
  constexpr std::size_t kGrain = 16;
  const tbb::blocked_range<std::size_t> all(0, count, kGrain);
  tbb::parallel_for(all, [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      mFirst[i + 1] = static_cast<std::size_t>(EdgeIndex(mBlocks.signs[i]).size());
  });
  std::partial_sum(mFirst.begin(), mFirst.end(), mFirst.begin());
  mCrossings.resize(mFirst.back());
  // Large, so not on the stack.
  tbb::enumerable_thread_specific<std::unique_ptr<HermiteBlock>> scratch(
      [] { return std::make_unique<HermiteBlock>(); });
  tbb::parallel_for(all, [&](const auto& range) {
    monitor.throwIfStopped();
    detail::isolated([&] {
      HermiteBlock& hermite = *scratch.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const EdgeIndex edges(mBlocks.signs[i]);
        source.fillHermite({mBlocks.coords[i], mBlocks.signs[i], edges}, hermite);
        Crossing* out = mCrossings.data() + mFirst[i];
        for (int e = 0; e < edges.size(); ++e) out[e] = {hermite.t[e], hermite.nx[e], hermite.ny[e], hermite.nz[e]};
      }
    });
  });
}

SampledSource::~SampledSource() = default;

SurfaceBlocks SampledSource::surfaceBlocks(const Monitor& monitor) const {
  monitor.throwIfStopped();
  return mBlocks;
}

void SampledSource::fillHermite(const SurfaceBlock& block, HermiteBlock& hermite) const {
  const auto& coords = mBlocks.coords;
  const auto i = static_cast<std::size_t>(std::lower_bound(coords.begin(), coords.end(), block.coord) - coords.begin());
  const Crossing* in = mCrossings.data() + mFirst[i];
  for (int e = 0; e < block.edges.size(); ++e) {
    hermite.t[e] = in[e].t;
    hermite.nx[e] = in[e].nx;
    hermite.ny[e] = in[e].ny;
    hermite.nz[e] = in[e].nz;
  }
}

}  // namespace pdc
