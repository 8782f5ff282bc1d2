#include "sample/implicit/block_forecast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "sample/implicit/block_signs.h"
#include "sample/implicit/cube_descent.h"

namespace pdc::detail {
namespace {

/// Cubes that are looked at on a level of the descent. With these, estimates of spheres are 15 to 25 % too high.
constexpr std::size_t kMostCubes = 512;

/// Evenly spaced ones of many cubes, which are in the order of their parents.
void thinOut(std::vector<Coord>& cubes) {
  if (cubes.size() <= kMostCubes) return;
  for (std::size_t i = 0; i < kMostCubes; ++i) cubes[i] = cubes[i * cubes.size() / kMostCubes];
  cubes.resize(kMostCubes);
}

/// How many of a block's own edges change sign.
double crossingsOf(const BlockSearch& search, const Coord& block) {
  // Blocks share the edges in their upper faces with others.
  constexpr double kOwnShare = double(kBlockSize * kBlockSize) / (kBlockPoints * kBlockPoints);
  BlockSigns signs;
  sampleSigns(search.field, search.frame, block, signs, nullptr);
  return signs.uniform() ? 0 : kOwnShare * EdgeIndex(signs).size();
}

}  // namespace

SurfaceForecast forecastSurfaceBlocks(const BlockSearch& search, const Monitor& monitor) {
  const Coord blocks = blockCounts(search);
  std::vector<Coord> cubes{Coord{0, 0, 0}};
  double weight = 1;  // Cubes that each one stands for.
  for (int level = topLevel(blocks); level > 0;) {
    dropOneSided(search, level, monitor, cubes);
    const std::vector<Coord> finer = children(cubes, --level, blocks);
    cubes = finer;
    thinOut(cubes);
    if (!cubes.empty()) weight *= static_cast<double>(finer.size()) / static_cast<double>(cubes.size());
  }
  SurfaceForecast forecast;
  forecast.memory = weight * static_cast<double>(cubes.size()) * (sizeof(Coord) + 1);
  dropOneSided(search, 0, monitor, cubes);
  std::vector<double> crossings(cubes.size());
  tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t i) {
    monitor.throwIfStopped();
    crossings[i] = crossingsOf(search, cubes[i]);
  });
  for (const double c : crossings) {
    forecast.crossings += weight * c;
    forecast.blocks += c > 0 ? weight : 0;
  }
  return forecast;
}

}  // namespace pdc::detail
