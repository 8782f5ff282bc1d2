#include "pdc/tile/slab_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "extract/contour_memory.h"
#include "extract/mesh_origin.h"
#include "extract/mesh_slab.h"
#include "parallel/machine_memory.h"
#include "parallel/with_threads.h"
#include "pdc/error.h"

namespace pdc {
namespace {

struct Layer {
  int x;
  std::uint64_t vertices = 0, blocks = 0;
};

/// The vertices of all layers from the first to the last that hold surface. The topology of some layers at a time is
/// in memory.
std::vector<Layer> layersOf(const SurfaceBlocks& blocks, const Monitor& monitor) {
  constexpr std::size_t kBlocksAtATime = 1 << 14;
  std::vector<Layer> layers;
  const auto endOfLayer = [&](std::size_t i) {
    return static_cast<std::size_t>(
        std::partition_point(blocks.coords.begin() + static_cast<std::ptrdiff_t>(i), blocks.coords.end(),
                             [x = blocks.coords[i][0]](const Coord& b) { return b[0] <= x; }) -
        blocks.coords.begin());
  };
  for (std::size_t begin = 0; begin < blocks.coords.size();) {
    std::size_t end = endOfLayer(begin);
    while (end < blocks.coords.size() && endOfLayer(end) - begin <= kBlocksAtATime) end = endOfLayer(end);
    const int first = blocks.coords[begin][0], last = blocks.coords[end - 1][0];
    // Vertices of a layer depend on the layers beside it.
    const SurfaceBlocks part = detail::blocksOfLayers(blocks, {first - 1, last + 2});
    const detail::Topology topology = detail::buildTopology(part, monitor);
    for (std::size_t i = 0; i < part.coords.size(); ++i) {
      const int x = part.coords[i][0];
      if (x < first || x > last) continue;
      if (layers.empty()) layers.push_back({x});
      while (layers.back().x < x) layers.push_back({layers.back().x + 1});
      layers.back().vertices += topology.blocks[i].vertexCount;
      ++layers.back().blocks;
    }
    begin = end;
  }
  return layers;
}

class Cutter {
 public:
  Cutter(const std::vector<Layer>& layers, const ContourOptions& options) : mLayers(layers), mOptions(options) {}

  /// As few slabs as fit into so many bytes each.
  [[nodiscard]] std::vector<Slab> fitting(double bytes) const {
    std::vector<Slab> slabs;
    for (std::size_t begin = 0; begin < mLayers.size();) {
      std::size_t end = begin + 1;
      const double least = memory(begin, end);
      if (least > bytes)
        throw Error(fmt::format(
            "a slab of one layer of blocks, with those about it, takes about {} of memory, more than the {} that are "
            "left of what is allowed; a coarser lattice takes less",
            detail::bytesText(least), detail::bytesText(std::max(bytes, 0.0))));
      while (end < mLayers.size() && memory(begin, end + 1) <= bytes) ++end;
      slabs.push_back(slab(begin, end));
      begin = end;
    }
    return slabs;
  }

  /// So many slabs, or as many as there are layers, of vertices as equal in number as whole layers allow.
  [[nodiscard]] std::vector<Slab> equal(std::size_t count) const {
    count = std::min(count, mLayers.size());
    const std::uint64_t all = vertices(0, mLayers.size());
    std::vector<Slab> slabs;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t most = mLayers.size() - (count - 1 - i);  // A layer for each of those to come.
      std::size_t end = begin + 1;
      while (end < most && (i + 1 == count || vertices(0, end) * count < all * (i + 1))) ++end;
      slabs.push_back(slab(begin, end));
      begin = end;
    }
    return slabs;
  }

 private:
  [[nodiscard]] std::uint64_t vertices(std::size_t begin, std::size_t end) const {
    std::uint64_t sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += mLayers[i].vertices;
    return sum;
  }
  [[nodiscard]] double memory(std::size_t begin, std::size_t end) const {
    constexpr auto kHalo = static_cast<std::size_t>(detail::kLeastHalo);
    const std::size_t low = begin - std::min(begin, kHalo), high = std::min(end + kHalo, mLayers.size());
    // The slab is taken out of what was contoured.
    const auto around = static_cast<double>(vertices(low, high)), own = static_cast<double>(vertices(begin, end));
    std::uint64_t blocks = 0;
    for (std::size_t i = low; i < high; ++i) blocks += mLayers[i].blocks;
    return detail::contourMemory(around, mOptions) + detail::contourMemory(own, mOptions) +
           detail::kBlockMemory * static_cast<double>(blocks);
  }
  [[nodiscard]] Slab slab(std::size_t begin, std::size_t end) const {
    return {mLayers[begin].x, mLayers[end - 1].x + 1, vertices(begin, end)};
  }

  const std::vector<Layer>& mLayers;
  const ContourOptions& mOptions;
};

/// Bytes that may be used beside what is in use now.
double bytesLeft(std::size_t maxMemory) {
  detail::giveBackMemory();
  const auto available = static_cast<double>(detail::availableMemory());
  if (maxMemory == 0) return available;
  return std::min(static_cast<double>(maxMemory) - static_cast<double>(detail::memoryInUse()), available);
}

}  // namespace

SlabPlan planSlabs(const HermiteSource& source, const ContourOptions& options, const SlabLimits& limits,
                   const Monitor& monitor) {
  if (options.adaptive || options.quadrics)
    throw std::invalid_argument("planSlabs: adaptive distances and quadrics are for whole meshes");
  if (limits.slabs < 0) throw std::invalid_argument(fmt::format("planSlabs: {} slabs", limits.slabs));
  return detail::withThreads(options.threads, [&] {
    const SurfaceBlocks blocks = source.surfaceBlocks(monitor);
    const detail::MeshOrigin place = detail::meshOrigin(source.map(), blocks, options.origin, options.exactSums);
    const std::vector<Layer> layers = layersOf(blocks, monitor);
    detail::checkVertexCount(std::accumulate(layers.begin(), layers.end(), std::uint64_t{0},
                                             [](std::uint64_t sum, const Layer& l) { return sum + l.vertices; }));
    const Cutter cutter(layers, options);
    return SlabPlan{.slabs = limits.slabs > 0 ? cutter.equal(static_cast<std::size_t>(limits.slabs))
                                              : cutter.fitting(bytesLeft(limits.maxMemory)),
                    .origin = place.origin,
                    .step = place.step};
  });
}

}  // namespace pdc
