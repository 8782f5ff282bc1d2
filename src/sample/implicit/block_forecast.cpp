#include "sample/implicit/block_forecast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "sample/implicit/block_signs.h"
#include "sample/implicit/cube_descent.h"

namespace pdc::detail {
namespace {

/// Cubes that are bounded on a level of the descent, and blocks whose points are sampled. With these, estimates of
/// spheres are 15 to 25 % too high.
constexpr std::size_t kMostCubes = 512, kMostSampled = 64;

/// Keeps evenly spaced ones of the cubes, which are in the order of their parents. \returns how many each one left
/// stands for.
double thinOut(std::vector<Coord>& cubes, std::size_t most) {
  const std::size_t all = cubes.size();
  if (all <= most) return 1;
  for (std::size_t i = 0; i < most; ++i) cubes[i] = cubes[i * all / most];
  cubes.resize(most);
  return static_cast<double>(all) / static_cast<double>(most);
}

/// How many of a block's own edges change sign.
double crossingsOf(const BlockSearch& search, const Coord& block) {
  // Blocks share the edges in their upper faces with others.
  constexpr double kOwnShare = double(kBlockSize * kBlockSize) / (kBlockPoints * kBlockPoints);
  BlockSigns signs;
  sampleSigns(*search.fields.in(block, 0), search.frame, block, signs, nullptr);
  return signs.uniform() ? 0 : kOwnShare * EdgeIndex(signs).size();
}

}  // namespace

SurfaceForecast forecastSurfaceBlocks(const BlockSearch& search, const Monitor& monitor) {
  const Coord blocks = blockCounts(search.cells);
  std::vector<Coord> cubes{Coord{0, 0, 0}};
  double weight = 1;  // Cubes that each one stands for.
  for (int level = topLevel(blocks); level > 0;) {
    dropOneSided(search, level, monitor, cubes);
    cubes = children(cubes, --level, blocks);
    weight *= thinOut(cubes, kMostCubes);
  }
  SurfaceForecast forecast;
  forecast.memory = weight * static_cast<double>(cubes.size()) * (sizeof(Coord) + 1);
  dropOneSided(search, 0, monitor, cubes);
  weight *= thinOut(cubes, kMostSampled);
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
