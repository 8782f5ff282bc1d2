#include "pdc/sample/normal_noise.h"

#include <tbb/combinable.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <memory>

#include "parallel/isolated.h"
#include "sample/block_origin.h"
#include "sample/normal_noise_histogram.h"

namespace pdc {

double normalNoise(const HermiteSource& source, const Monitor& monitor) {
  const SurfaceBlocks blocks = source.surfaceBlocks(monitor);
  tbb::enumerable_thread_specific<std::unique_ptr<HermiteBlock>> scratch(
      [] { return std::make_unique<HermiteBlock>(); });
  tbb::combinable<detail::NormalNoiseHistogram> parts;
  const LatticeMap& map = source.map();
  tbb::parallel_for(std::size_t{0}, blocks.coords.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    detail::isolated([&] {
      HermiteBlock& hermite = *scratch.local();
      const EdgeIndex edges(blocks.signs[i]);
      source.fillHermite({blocks.coords[i], blocks.signs[i], edges}, hermite);
      const Mat3d linear = map.jacobian(detail::blockOrigin(blocks.coords[i]));
      parts.local().add(hermite, edges, matCast<float>(linear));
    });
  });
  detail::NormalNoiseHistogram all;
  parts.combine_each([&](const detail::NormalNoiseHistogram& part) { all += part; });
  return all.sigma();
}

}  // namespace pdc
